// Text as XML and HTML hold it, for pages, drawings and ParaView's files.
#pragma once

#include <string>
#include <string_view>

namespace soilbin {

/// Text as the content of an element or of an attribute: & < > " ' as entities, control characters that XML forbids as
/// spaces.
std::string escaped(std::string_view text);

}  // namespace soilbin
