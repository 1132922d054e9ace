// Records: values as bytes, to be kept in files and read again by the same build of the program.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace feedhold {

/// Numbers with a blank behind them; texts as their size, a blank and their bytes.
class RecordWriter {
public:
  void number(std::uint64_t value);
  void text(std::string_view value);
  void real(double value);
  template <typename Value, typename Write> void optional(const std::optional<Value> &value, Write write) {
    number(value ? 1 : 0);
    if (value)
      write(*value);
  }
  template <typename Values, typename Write> void list(const Values &values, Write write) {
    number(values.size());
    for (const auto &value : values)
      write(value);
  }
  std::string finish() { return std::move(bytes_); }

private:
  std::string bytes_;
};

/// After the first thing that does not fit everything is 0 and empty.  Texts lie in the bytes that are read.
class RecordReader {
public:
  explicit RecordReader(std::string_view bytes) : rest_(bytes) {}

  std::uint64_t number();
  std::uint64_t numberUpTo(std::uint64_t most);
  std::string_view text();
  double real();
  template <typename Enum> Enum oneOf(std::uint64_t count) { return static_cast<Enum>(numberUpTo(count - 1)); }
  template <typename Enum> Enum upTo(Enum last) { return oneOf<Enum>(static_cast<std::uint64_t>(last) + 1); }
  bool isPresent() { return numberUpTo(1) == 1; }
  /// How many rows follow: no more than there are bytes.
  std::uint64_t count() { return numberUpTo(rest_.size()); }
  template <typename Read> void list(Read read) {
    for (std::uint64_t left = count(); left > 0 && !failed_; --left)
      read();
  }
  bool hasFailed() const { return failed_; }
  bool isDone() const { return !failed_ && rest_.empty(); }
  /// Makes what was read useless; 0.
  std::uint64_t fail();

private:
  std::string_view rest_;
  bool failed_ = false;
};

} // namespace feedhold
