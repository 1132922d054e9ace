// Mutation: the programs of the literature with one slip each.  A claim that a run breaks must not be
// proved of the mutant, and a mutant whose runs come to other ends must lose a proof, with a witness or a reason.
// MUTATION_MUTANTS chooses how many of them are tried, of all programs.
#include "base/support/parallel.h"
#include "mutation/mutants.h"
#include "mutation/packages.h"
#include "proof/sample_proofs.h"
#include "proof/short_programs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <iostream>
#include <map>

namespace feedhold::mutation {
namespace {

using proof_tests::ProofTrial;
using proof_tests::SampleKind;
using soundness::ProgramLines;
using soundness::Random;
using soundness::Sample;

constexpr int kRuns = 60;
constexpr std::uint64_t kInputs = 1;
constexpr SampleKind kMutants{"mutant", proof_tests::shortSample, proof_tests::shortEntry};

/// Programs of the literature, most of them without contracts; package_mutation_test.cpp has the others.
std::vector<std::pair<std::string, ProgramLines>> originals() {
  const std::filesystem::path folder = std::filesystem::path(FEEDHOLD_ROOT) / "tests/proof/literature";
  std::vector<std::filesystem::path> paths;
  for (const auto &entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".nc")
      paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  std::vector<std::pair<std::string, ProgramLines>> programs;
  for (const auto &path : paths)
    programs.emplace_back(path.stem().string(), linesOf(path.string()));
  return programs;
}

struct Original {
  std::string name;
  ProgramLines lines;
  ProofTrial trial = {};
};
struct Try {
  const Original *original;
  Mutant mutant;
  ProofTrial trial = {};
};

ProofTrial triedOut(const ProgramLines &lines) {
  return proof_tests::tryProofs(kMutants, {"fanuc-30i", lines}, kInputs, kRuns);
}

/// In an order of their own, the same each time.
template <typename Things> void mix(Things &things) {
  Random random(1);
  for (std::size_t i = 0; i + 1 < things.size(); ++i)
    std::swap(things[i], things[i + random.below(static_cast<std::uint32_t>(things.size() - i))]);
}

/// Programs of which all is proved.
std::vector<Original> provedOriginals(std::size_t most) {
  std::vector<Original> all;
  for (auto &[name, lines] : originals())
    all.push_back({std::move(name), std::move(lines)});
  mix(all);
  all.resize(std::min(most, all.size()));
  parallelFor(all.size(), 0, [&](std::size_t i) { all[i].trial = triedOut(all[i].lines); });
  std::erase_if(all,
                [](const Original &each) { return each.trial.explained != 0 || each.trial.tally.incomplete != 0; });
  return all;
}

std::vector<Try> triesOf(const std::vector<Original> &programs, std::size_t most) {
  std::vector<Try> tries;
  for (const Original &original : programs)
    for (Mutant &mutant : mutantsOf(original.lines))
      tries.push_back({&original, std::move(mutant)});
  mix(tries);
  tries.resize(std::min(most, tries.size()));
  parallelFor(tries.size(), 0, [&](std::size_t i) { tries[i].trial = triedOut(tries[i].mutant.lines); });
  return tries;
}

/// Some run comes to an end to which none of the original comes: an alarm, none at all, a promise that is broken.
bool behavesOtherwise(const Try &each) {
  const auto &known = each.original->trial.ends;
  return std::any_of(each.trial.ends.begin(), each.trial.ends.end(),
                     [&](const std::string &end) { return std::find(known.begin(), known.end(), end) == known.end(); });
}

struct Row {
  int mutants = 0;
  int changed = 0;
  int lost = 0;
  int wrong = 0;
};

TEST(Mutation, MutantsLoseTheirProofs) {
  constexpr std::size_t kUsualPrograms = 30;
  constexpr std::size_t kUsualMutants = 60;
  const char *text = std::getenv("MUTATION_MUTANTS");
  const std::size_t most = text ? std::strtoull(text, nullptr, 10) : kUsualMutants;
  const std::vector<Original> programs = provedOriginals(text ? ~std::size_t{0} : kUsualPrograms);
  std::map<std::string_view, Row> rows;
  Row all;
  for (const Try &each : triesOf(programs, most)) {
    const bool isChanged = behavesOtherwise(each);
    const bool isLost = each.trial.explained != 0;
    for (Row *row : {&rows[each.mutant.slip], &all}) {
      ++row->mutants;
      row->changed += isChanged ? 1 : 0;
      row->lost += isChanged && isLost ? 1 : 0;
      row->wrong += each.trial.wrong ? 1 : 0;
    }
    if (each.trial.wrong)
      ADD_FAILURE() << each.original->name << ", " << each.mutant.slip << ": " << *each.trial.wrong << "\n"
                    << soundness::textOf(each.mutant.lines);
    else if (isChanged && !isLost)
      std::cout << each.original->name << ", " << each.mutant.slip << ": no proof is lost\n"
                << soundness::textOf(each.mutant.lines);
  }
  rows["all"] = all;
  std::cout << programs.size() << " programs\n";
  for (const auto &[slip, row] : rows)
    std::cout << fmt::format("{:20} {:4} mutants, {:4} behave otherwise, {:4} of these lose a proof, {} wrong\n", slip,
                             row.mutants, row.changed, row.lost, row.wrong);
  EXPECT_LE(all.changed * 9, all.lost * 10);
}

} // namespace
} // namespace feedhold::mutation
