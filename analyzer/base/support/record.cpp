#include "base/support/record.h"

#include <fmt/format.h>

#include <bit>
#include <charconv>

namespace feedhold {

void RecordWriter::number(std::uint64_t value) { bytes_ += fmt::format("{} ", value); }

void RecordWriter::text(std::string_view value) {
  number(value.size());
  bytes_ += value;
}

void RecordWriter::real(double value) { number(std::bit_cast<std::uint64_t>(value)); }

std::uint64_t RecordReader::number() {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), value);
  const auto size = static_cast<std::size_t>(end - rest_.data());
  if (error != std::errc{} || size >= rest_.size() || *end != ' ')
    return fail();
  rest_.remove_prefix(size + 1);
  return value;
}

std::uint64_t RecordReader::numberUpTo(std::uint64_t most) {
  const std::uint64_t value = number();
  return value <= most ? value : fail();
}

std::string_view RecordReader::text() {
  const std::uint64_t size = number();
  if (size > rest_.size()) {
    fail();
    return {};
  }
  const std::string_view value = rest_.substr(0, size);
  rest_.remove_prefix(value.size());
  return value;
}

double RecordReader::real() { return std::bit_cast<double>(number()); }

std::uint64_t RecordReader::fail() {
  failed_ = true;
  rest_ = {};
  return 0;
}

} // namespace feedhold
