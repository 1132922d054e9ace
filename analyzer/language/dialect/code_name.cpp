#include "language/dialect/code_name.h"

namespace feedhold {

std::string codeName(char letter, std::uint32_t tenths) {
  const std::string whole = std::to_string(tenths / 10);
  const std::string name = letter + std::string(whole.size() < 2 ? "0" : "") + whole;
  return tenths % 10 == 0 ? name : name + "." + std::to_string(tenths % 10);
}

} // namespace feedhold
