// Obligations from a folder of SMT-LIB files, each with its known answer in a line `; expect: sat` or `; expect:
// unsat`. Runs where FEEDHOLD_OBLIGATIONS names such a folder.
#include "proof/decide/discharge.h"
#include "proof/smt/smtlib.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>

namespace feedhold::prove {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> obligations() {
  const char *folder = std::getenv("FEEDHOLD_OBLIGATIONS");
  std::vector<fs::path> files;
  if (folder == nullptr)
    return files;
  for (const fs::directory_entry &entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".smt2")
      files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

std::string contentOf(const fs::path &file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::string verdictOf(const Outcome &outcome) {
  if (outcome.counterexample() != nullptr)
    return "counterexample";
  if (!outcome.proved())
    return "unknown: " + std::get<Unknown>(outcome.answer).reason;
  return std::get<Proved>(outcome.answer).grade == Grade::Certified ? "certified" : "two-solvers";
}

TEST(Obligations, NoneIsAnsweredWrong) {
  const std::vector<fs::path> files = obligations();
  if (files.empty())
    GTEST_SKIP() << "FEEDHOLD_OBLIGATIONS names no folder of obligations";
  std::map<std::string, int> counts;
  for (const fs::path &file : files) {
    const std::string text = contentOf(file);
    smt::TermStore store;
    Result<std::vector<smt::TermId>> formulas = smt::readSmtLib(store, text);
    if (!formulas) {
      ++counts["not readable"];
      continue;
    }
    const Outcome outcome = discharge(store, {formulas.value(), store.no()});
    const std::string verdict = verdictOf(outcome);
    fmt::print("{:32} {:10} {:9} {}\n", file.filename().string(), outcome.method, outcome.effort, verdict);
    ++counts[verdict.substr(0, verdict.find(':'))];
    if (text.find("expect: unsat") == std::string::npos)
      EXPECT_FALSE(outcome.proved()) << file;
    else
      EXPECT_EQ(outcome.counterexample(), nullptr) << file;
  }
  for (const auto &[verdict, count] : counts)
    fmt::print("{}: {}\n", verdict, count);
}

} // namespace
} // namespace feedhold::prove
