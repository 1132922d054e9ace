// The programs of this folder: no verdict contradicts answers.md.  LITERATURE_ONLY names one program.
#include "proof/family/known_answers.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <map>
#include <random>
#include <sstream>

namespace feedhold::proof_tests {
namespace {

namespace fs = std::filesystem;

constexpr int kLeastPrograms = 60;
constexpr int kTrials = 20;

const fs::path kFolder = LITERATURE_DIR;

std::string contentOf(const fs::path &file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// The cells of a row of a table, without blanks around them.
std::vector<std::string> cellsOf(const std::string &line) {
  std::vector<std::string> cells;
  std::istringstream text(line.substr(1));
  for (std::string cell; std::getline(text, cell, '|');) {
    const std::size_t first = cell.find_first_not_of(' ');
    cells.push_back(first == std::string::npos ? "" : cell.substr(first, cell.find_last_not_of(' ') + 1 - first));
  }
  return cells;
}

/// `#501=1 #2=-.5`
Inputs inputsOf(const std::string &text) {
  Inputs inputs;
  std::istringstream words(text);
  for (std::string word; words >> word;)
    if (word.starts_with('#'))
      inputs.emplace_back(std::stoul(word.substr(1)), std::stod(word.substr(word.find('=') + 1)));
  return inputs;
}

/// Values of all kinds in the variables that the programs take for arguments.
std::vector<Inputs> anyInputs() {
  std::mt19937 random(1);
  std::vector<Inputs> trials;
  for (int i = 0; i < kTrials; ++i) {
    Inputs inputs;
    for (const std::uint32_t variable : {1, 2, 501, 502, 503})
      if (random() % 5 != 0)
        inputs.emplace_back(variable, static_cast<double>(random() % 81) / (random() % 3 == 0 ? 4 : 1) - 10);
    trials.push_back(std::move(inputs));
  }
  return trials;
}

std::vector<KnownProgram> knownPrograms() {
  const char *only = std::getenv("LITERATURE_ONLY");
  std::map<std::string, KnownProgram> programs;
  std::ifstream table(kFolder / "answers.md");
  for (std::string line; std::getline(table, line);) {
    if (!line.starts_with("| ") || line.starts_with("| program"))
      continue;
    const std::vector<std::string> cells = cellsOf(line);
    if (cells.size() != 4 || (only && cells[0] != only))
      continue;
    KnownProgram &program = programs[cells[0]];
    program.name = cells[0];
    program.answers.push_back(
        {cells[1], cells[2] == "proved" ? prove::Verdict::Proved : prove::Verdict::Refuted, inputsOf(cells[3])});
  }
  std::vector<KnownProgram> all;
  for (auto &[name, program] : programs) {
    program.text = contentOf(kFolder / (name + ".nc"));
    if (program.text.find("(@") == std::string::npos)
      program.trials = anyInputs();
    all.push_back(std::move(program));
  }
  return all;
}

TEST(Literature, NoVerdictIsWrong) {
  const Comparison comparison = compareWithVerdicts(knownPrograms());
  std::cout << summary(comparison);
  EXPECT_TRUE(comparison.wrong.empty());
  if (!std::getenv("LITERATURE_ONLY")) {
    EXPECT_GE(comparison.programs, kLeastPrograms);
    EXPECT_GE(comparison.decidedPercent(), 85);
  }
}

TEST(Literature, EveryProgramHasAnAnswer) {
  const std::string table = contentOf(kFolder / "answers.md");
  for (const fs::directory_entry &entry : fs::directory_iterator(kFolder))
    if (entry.path().extension() == ".nc") {
      EXPECT_NE(table.find("| " + entry.path().stem().string() + " |"), std::string::npos) << entry.path();
    }
}

} // namespace
} // namespace feedhold::proof_tests
