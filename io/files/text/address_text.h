// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

namespace arete {

/// An address may hold a secret: the query of a signed one ("?X-Amz-Signature=...", "?sig=...", "?token=...")
/// and the name and password before its host are keys to the data. What is written or shown is without them.

/// Removes the name and password, the query and the fragment from every http, https and ftp address
/// that stands in a text: "https://u:p@host/a.tif?sig=x" becomes "https://host/a.tif". An address ends at
/// white space, at a quotation mark, at one of <>{}|\^` or at the end of the text; punctuation at its end
/// stays. The options in "/vsicurl?...&url=...", GDAL's other form of an address, are removed as well. Other
/// text, question marks included, stays. O(text).
std::string withoutQueries(std::string_view text);

/// The same for the name of a file, which may be an address as a whole or contain one
/// ("/vsizip//vsicurl/https://..."): nothing but a closing brace ends the address in it. Names of other files
/// stay. O(name).
std::string nameWithoutQuery(std::string_view name);

}  // namespace arete
