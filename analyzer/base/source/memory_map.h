// MemoryMap: the bytes of a file without copying them.  Internal to source/; the .cpp is the one that speaks to the
// operating system, and another system needs only another such file.
#pragma once

#include "base/support/result.h"

#include <cstdint>
#include <filesystem>
#include <string_view>

namespace feedhold {

class MemoryMap {
public:
  /// Maps a regular file for reading.  The mapping shows the file as it is on the disk: whoever rewrites a file that is
  /// open here must write a new one and rename it.
  static Result<MemoryMap> open(const std::filesystem::path &path, std::uint64_t largestSize);

  MemoryMap() = default;
  MemoryMap(MemoryMap &&other) noexcept;
  MemoryMap &operator=(MemoryMap &&other) noexcept;
  ~MemoryMap();

  std::string_view bytes() const { return bytes_; }

private:
  explicit MemoryMap(std::string_view bytes) : bytes_(bytes) {}
  std::string_view bytes_;
};

} // namespace feedhold
