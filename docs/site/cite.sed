#!/bin/sed -Ef
# Doxygen's input filter: in comments, a key of docs/bibliography.md in brackets becomes a link to its entry.
/\/\//s~(^|[^]A-Za-z0-9_])\[((de)?[A-Z][A-Za-z]+[0-9]{4}[a-z]?)\]~\1<a href="../bibliography.html#\2">[\2]</a>~g
