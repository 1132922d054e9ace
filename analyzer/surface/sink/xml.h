// XML: text as it stands in a document.  Internal to sink/.
#pragma once

#include <string>
#include <string_view>

namespace feedhold {

/// For text and for attributes; what XML 1.0 cannot hold becomes U+FFFD.
std::string xml(std::string_view text);

} // namespace feedhold
