// Internal to this room: single values out of RDF/XMP text, without an XML parser.
#pragma once

#include <optional>
#include <string_view>

namespace shoal::media {

// The text of <name>value</name> or name="value", whichever comes first, without surrounding white space.
// Nothing if absent, not closed, or longer than 64 characters.
std::optional<std::string_view> rdfValue(std::string_view text, std::string_view name);

// The same as a finite number.
std::optional<double> rdfNumber(std::string_view text, std::string_view name);

} // namespace shoal::media
