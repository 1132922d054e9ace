// Mutation of packages: what runs break of a contract must not be proved, and is refuted in most cases.
// MUTATION_PACKAGES chooses how many mutants are tried; MUTATION_SEED, which.
#include "base/support/parallel.h"
#include "mutation/mutants.h"
#include "mutation/packages.h"
#include "mutation/replay.h"
#include "proof/prove/prove.h"
#include "proof/replay/exact_run.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fmt/format.h>
#include <iostream>
#include <map>
#include <memory>

namespace feedhold::mutation {
namespace {

using prove::Obligation;
using prove::ObligationKind;
using prove::Verdict;
using soundness::ProgramLines;
using soundness::Random;

constexpr int kRuns = 60;

std::uint64_t numberFrom(const char *variable, std::uint64_t usual) {
  const char *text = std::getenv(variable);
  return text ? std::strtoull(text, nullptr, 10) : usual;
}

struct Original {
  PackageText text;
  std::vector<Start> starts = {};
  std::vector<Mutant> mutants = {};
};

/// What became of the claims that runs break.
struct Judged {
  bool isBroken = false;
  bool isRefuted = false;           // some claim, with a witness
  std::vector<std::string> rounded; // proved, and broken only where doubles come out elsewhere than exact numbers
  std::vector<std::string> wrong;   // proved, and broken
  std::vector<std::string> open;    // what is broken and not refuted, with what is said of it
};

bool speaksOf(const Obligation &obligation, const Break &found) {
  if (obligation.kind != found.kind)
    return false;
  switch (found.kind) {
  case ObligationKind::KeepIn:
  case ObligationKind::KeepOut:
    return obligation.place == found.place && obligation.id.find("." + found.name + ".") != std::string::npos;
  case ObligationKind::NoControlAlarm:
    return obligation.place == found.place && obligation.span == found.span &&
           meaningOf(*obligation.alarm) == found.name;
  case ObligationKind::AlarmUnreachable: return obligation.place == found.place && obligation.span == found.span;
  case ObligationKind::Compensation:
  case ObligationKind::Clearance:
  case ObligationKind::Travel:
  case ObligationKind::Limit:
  case ObligationKind::CallMeetsContract:
  case ObligationKind::LoopEnds: return obligation.place == found.place;
  case ObligationKind::Ensures:
  case ObligationKind::ModalPreserved:
  case ObligationKind::AlarmIff: return obligation.claim == found.name;
  case ObligationKind::ProgramEnds:
  case ObligationKind::Assigns:
  case ObligationKind::Guarded:
  case ObligationKind::ContractSatisfiable: return true;
  }
  return false;
}

prove::ProgramProof provedKinds(const ReplayedProgram &program, const std::vector<Break> &breaks) {
  prove::ProveOptions options;
  for (const Break &each : breaks)
    options.only.push_back(each.kind);
  options.guards = prove::InferGuards::No;
  options.contractsOf = {&program.contracts()};
  return prove::prove(program.loaded().set, program.entry(), &program.contracts(), options);
}

/// What was proved is excused by calls close by that keep the claim, if the same run in exact numbers does not come to
/// the same end, or is too long to tell.
class Rounding {
public:
  Rounding(const ReplayedProgram &program, const std::vector<Start> &starts) : program_(program), starts_(starts) {}

  bool alone(const Break &found) {
    const auto [known, isNew] = around_.try_emplace(found.start);
    if (isNew && !agrees(starts_[found.start]))
      known->second = program_.breaksAround(starts_[found.start]);
    return known->second && std::none_of(known->second->begin(), known->second->end(),
                                         [&](const Break &each) { return each.isOfSameClaim(found); });
  }

private:
  bool agrees(const Start &start) const {
    prove::ExactRuns runs([&](const GivenVariables &given) {
      return prove::exploreExactly(program_.loaded().set, program_.entry(), given);
    });
    return runs.agrees(start.given, program_.run(start)) == prove::Agreement::Same;
  }

  const ReplayedProgram &program_;
  const std::vector<Start> &starts_;
  std::map<std::size_t, std::optional<std::vector<Break>>> around_; // by call; absent: exact numbers agree
};

Judged judged(const ReplayedProgram &program, const std::vector<Start> &starts) {
  Judged result;
  const std::vector<Break> breaks = program.breaks(starts);
  result.isBroken = !breaks.empty();
  if (breaks.empty())
    return result;
  const prove::ProgramProof proof = provedKinds(program, breaks);
  result.isRefuted = std::any_of(proof.obligations.begin(), proof.obligations.end(), [&](const Obligation &each) {
    return each.verdict == Verdict::Refuted && each.verdict.witness() &&
           (each.kind != ObligationKind::AlarmUnreachable || // of alarms that may be raised, a promise speaks
            std::any_of(breaks.begin(), breaks.end(), [&](const Break &found) { return speaksOf(each, found); }));
  });
  Rounding rounding(program, starts);
  for (const Break &each : breaks) {
    const Start &start = starts[each.start];
    const auto said = std::find_if(proof.obligations.begin(), proof.obligations.end(),
                                   [&](const Obligation &obligation) { return speaksOf(obligation, each); });
    const bool isClaimed = said != proof.obligations.end();
    const std::string text = fmt::format(
        "{} {}: {} ({}); {}", nameOf(each.kind), each.name, each.what, program.textOf(start),
        !isClaimed             ? std::string("nothing is claimed")
        : holds(said->verdict) ? fmt::format("{} is {}", said->id, nameOf(said->verdict))
                               : fmt::format("{} is {}: {}", said->id, nameOf(said->verdict), said->verdict.reason()));
    const bool isTakenToHold = isClaimed ? holds(said->verdict) : !proof.incomplete;
    if (isTakenToHold && rounding.alone(each))
      result.rounded.push_back(text);
    else if (isTakenToHold)
      result.wrong.push_back(text);
    else if (!isClaimed || said->verdict != Verdict::Refuted)
      result.open.push_back(text);
  }
  return result;
}

std::vector<Original> originals() {
  std::vector<Original> all;
  for (PackageText &package : provedPackages())
    all.push_back({std::move(package)});
  parallelFor(all.size(), 0, [&](std::size_t i) {
    Random random(i + 1);
    all[i].starts = ReplayedProgram(all[i].text.dialect, all[i].text.lines).starts(random, kRuns);
    all[i].mutants = movingMutantsOf(all[i].text.lines);
  });
  return all;
}

/// Without the calls on which doubles alone already lead the program itself elsewhere.
void dropRounded(std::vector<Original> &programs) {
  parallelFor(programs.size(), 0, [&](std::size_t i) {
    const ReplayedProgram program(programs[i].text.dialect, programs[i].text.lines);
    std::erase_if(programs[i].starts, [&](const Start &start) { return !program.breaks({start}).empty(); });
  });
}

struct Choice {
  const Original *original;
  const Mutant *mutant;
  Judged judged = {};
};

/// In an order of their own, as many of each package as far as it has them.
std::vector<Choice> chosen(const std::vector<Original> &programs, std::size_t most, std::uint64_t seed) {
  std::map<std::string_view, std::vector<Choice>> pools;
  for (const Original &original : programs)
    for (const Mutant &mutant : original.mutants)
      pools[original.text.package].push_back({&original, &mutant});
  Random random(seed);
  std::vector<Choice> choices;
  while (choices.size() < most && !pools.empty()) {
    for (auto &[package, pool] : pools)
      if (choices.size() < most) {
        std::swap(pool[random.below(static_cast<std::uint32_t>(pool.size()))], pool.back());
        choices.push_back(std::move(pool.back()));
        pool.pop_back();
      }
    std::erase_if(pools, [](const auto &each) { return each.second.empty(); });
  }
  return choices;
}

std::string headOf(const Choice &choice) {
  const Mutant &mutant = *choice.mutant;
  return fmt::format("{}, {}: `{}` for `{}`", choice.original->text.name, mutant.slip, mutant.lines[mutant.line],
                     choice.original->text.lines[mutant.line]);
}

struct Row {
  int mutants = 0;
  int broken = 0;
  int refuted = 0;
  int open = 0;
  int byRounding = 0;
  int wrong = 0;

  void add(const Judged &judged) {
    ++mutants;
    broken += judged.isBroken ? 1 : 0;
    refuted += judged.isBroken && judged.isRefuted ? 1 : 0;
    byRounding += !judged.rounded.empty() ? 1 : 0;
    wrong += judged.wrong.empty() ? 0 : 1;
    open += judged.isBroken && !judged.isRefuted && judged.rounded.empty() && judged.wrong.empty() ? 1 : 0;
  }
};

void report(const std::vector<Choice> &choices) {
  std::map<std::string_view, Row> slips;
  Row all;
  for (const Choice &choice : choices) {
    const Judged &judged = choice.judged;
    slips[choice.mutant->slip].add(judged);
    all.add(judged);
    if (!judged.rounded.empty())
      std::cout << headOf(choice) << "\n  by rounding: " << judged.rounded.front() << "\n";
    for (const std::string &wrong : judged.wrong)
      ADD_FAILURE() << headOf(choice) << ": " << wrong;
    if (judged.isBroken && !judged.isRefuted && !judged.open.empty())
      std::cout << headOf(choice) << "\n  not refuted: " << judged.open.front() << "\n";
  }
  slips["all"] = all;
  for (const auto &[slip, row] : slips)
    std::cout << fmt::format("{:20} {:5} mutants, {:5} break their contract, {:5} of these refuted, {:4} unknown, "
                             "{:3} by rounding alone, {} wrong\n",
                             slip, row.mutants, row.broken, row.refuted, row.open, row.byRounding, row.wrong);
  EXPECT_LE((all.broken - all.byRounding) * 9, all.refuted * 10);
}

TEST(PackageMutation, ProvedPackagesKeepTheirContractsInRuns) {
  const std::vector<Original> programs = originals();
  ASSERT_FALSE(programs.empty());
  std::vector<std::string> said(programs.size());
  parallelFor(programs.size(), 0, [&](std::size_t i) {
    const ReplayedProgram program(programs[i].text.dialect, programs[i].text.lines);
    Rounding rounding(program, programs[i].starts);
    for (const Break &each : program.breaks(programs[i].starts))
      if (!rounding.alone(each))
        said[i] += fmt::format("{} {}: {} ({})\n", nameOf(each.kind), each.name, each.what,
                               program.textOf(programs[i].starts[each.start]));
  });
  for (std::size_t i = 0; i < programs.size(); ++i) {
    EXPECT_EQ(said[i], "") << programs[i].text.name;
    std::cout << fmt::format("{}: {} calls, {} mutants\n", programs[i].text.name, programs[i].starts.size(),
                             programs[i].mutants.size());
  }
}

TEST(PackageMutation, WhatRunsBreakIsNotProved) {
  constexpr std::uint64_t kUsual = 18;
  std::vector<Original> programs = originals();
  ASSERT_FALSE(programs.empty());
  dropRounded(programs);
  std::vector<Choice> choices =
      chosen(programs, numberFrom("MUTATION_PACKAGES", kUsual), numberFrom("MUTATION_SEED", 1));
  parallelFor(choices.size(), 0, [&](std::size_t i) {
    const Original &original = *choices[i].original;
    choices[i].judged = judged(ReplayedProgram(original.text.dialect, choices[i].mutant->lines), original.starts);
  });
  report(choices);
}

} // namespace
} // namespace feedhold::mutation
