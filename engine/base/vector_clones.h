// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// Placed before a function whose loops gain from newer instruction sets: it is compiled for several, and the
/// loader selects one that the machine has. The results are the same. Empty with sanitizers, whose runtime
/// has not started when the loader selects, and with compilers that do not know the levels.
#if defined(__x86_64__) && defined(__linux__) && defined(__GNUC__) && !defined(__clang__) && \
    __GNUC__ >= 12 && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define ARETE_VECTOR_CLONES __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define ARETE_VECTOR_CLONES
#endif
