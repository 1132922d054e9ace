// generate_input KIND LINES: writes a benchmark program to standard output.
#include "bench/generate.h"

#include <cstdio>
#include <cstdlib>

int main(int argc, char **argv) {
  const auto kind = argc == 3 ? feedhold::bench::inputKindFromName(argv[1]) : std::nullopt;
  if (!kind) {
    std::fputs("usage: generate_input plain|macro|plain-long|macro-long LINES\n", stderr);
    return 2;
  }
  const std::string text = feedhold::bench::generate(*kind, std::strtoul(argv[2], nullptr, 10));
  return std::fwrite(text.data(), 1, text.size(), stdout) == text.size() ? 0 : 1;
}
