// Random programs on random inputs: every state of every run lies in a state that the analysis tells of its place, and
// every alarm that stops a run is foreseen.  SOUNDNESS_FIRST and SOUNDNESS_PROGRAMS choose other programs.
#include "dialects/registry.h"
#include "soundness/sample_runs.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <iostream>

namespace feedhold::soundness {
namespace {

constexpr int kRuns = 30;
constexpr int kMostShown = 6;

std::uint64_t fromEnvironment(const char *name, std::uint64_t otherwise) {
  const char *text = std::getenv(name);
  return text ? std::strtoull(text, nullptr, 10) : otherwise;
}

void expectForeseen(const Sample &sample) {
  Tally tally;
  const auto why = unforeseen(sample, 1, kRuns, tally);
  EXPECT_FALSE(why) << sample.dialect << ": " << why.value_or("") << "\n" << textOf(sample.lines);
}

/// What random programs have found, as little of each as shows it.
TEST(Soundness, FoundBefore) {
  const Sample samples[] = {
      // M99 P of a modal macro: its variables are kept for the next call.
      {"fanuc-30i", {"N10G66P4I-2.5", "G0X0.3Y#4", "O4", "#4=-#2", "M99P10"}},
      // A centre without a mapping outlives what is not followed.
      {"fanuc-30i", {"/N40G51X#500Y-#500", "M#2"}},
      {"fanuc-30i", {"N20M98P3", "G65P9L0B-.1", "IF[-#100 LT 30.]GOTO20", "O3", "G51X99999999Z#3", "M99"}},
      // A lone vacant word is no arc, and no hole; a cycle may be in force or not.
      {"fanuc-30i",
       {"N10G66P2A#500D17.X10Z#2F#2", "G2Y[17.]Z-#100I#4J100.", "X#3", "O2", "WHILE[#110 LT 3.5]DO1",
        "N10G99G81X1.5Z-#0", "#110=#110+2", "END1", "M99"}},
      {"fanuc-30i", {"G17", "N40G99G81K0"}},
      // There is no -0.
      {"fanuc-30i", {"#1=ATAN[ABS[#1]]/[ROUND[-.1]]"}},
      // L of G66; each pass finds the variables of the pass before.
      {"fanuc-30i", {"G66P3L2A#1", "G69X#100", "O3", "#4=7", "M99"}},
      // G10 to an offset that the control does not have, or while it is not known which is in force.
      {"haas-classic", {"G10L2P#1X-2.5Z90."}},
      {"linuxcnc", {"g10 l20 p1 z#100"}},
      // A restored code that none was, and one that writes where the signal came.
      {"haas-ngc", {"#32=#4014", "G#32"}},
      {"fanuc-30i-lathe", {"#31=#4001", "N10G#31"}},
      // M97 with a computed number calls a part of its own program, and may call itself.
      {"haas-ngc", {"O1", "N20M97P#1"}},
      {"haas-ngc", {"O1", "/2M97P#1"}},
      {"haas-classic", {"/2N10M97P#1", "O2"}},
      {"haas-classic", {"M97P#1", "M30", "N10#1=5", "WHILE[#1GT0]DO1", "N20#1=#1-1", "END1", "M99"}},
      // What is not followed may have ended the modal call that was known.
      {"fanuc-0i", {"O1", "G65P#1L2Z#4K#100", "N20G66P4A10I#1J-1Z0", "M98P3", "O3", "G67"}},
      // Named variables belong to a level.
      {"linuxcnc", {"o1 sub", "#<x>=[#<x>+1]", "o1 endsub [#<x>]", "#<x>=1", "o1 call", "#<x>=[#<x>+#<_value>]"}},
      {"linuxcnc", {"#<n5>=-1", "m98 p50", "#1=#<n5>", "m2", "o50", "#<n5>=3", "m99"}},
  };
  for (const Sample &sample : samples)
    expectForeseen(sample);
}

TEST(Soundness, EverySystemVariable) {
  for (const Dialect *dialect : allDialects().dialects)
    for (const VariableRange &range : dialect->variables)
      for (const std::uint32_t number : {range.first, range.last}) {
        const std::string variable = "#" + std::to_string(number);
        expectForeseen({dialect->id, {"#1=" + variable, "X" + variable, "G1Z[" + variable + "+#1]"}});
        expectForeseen({dialect->id, {variable + "=#2", "#3=" + variable, "G1X#3", "#4=" + variable}});
        expectForeseen({dialect->id, {"#[" + std::to_string(number) + "+#1]=#[#3]", "#3=" + variable, "G1X#3"}});
      }
}

TEST(Soundness, EveryRunIsForeseen) {
  const std::uint64_t first = fromEnvironment("SOUNDNESS_FIRST", 1);
  const std::uint64_t programs = fromEnvironment("SOUNDNESS_PROGRAMS", 1200);
  Tally tally;
  int wrong = 0;
  for (std::uint64_t seed = first; seed < first + programs; ++seed) {
    Random random(seed);
    const Sample sample = macroSample(random);
    const std::uint64_t inputs = random.next();
    if (!unforeseen(sample, inputs, kRuns, tally))
      continue;
    const Sample least = shrunk(sample, inputs, kRuns);
    Tally ignored;
    ADD_FAILURE() << "program " << seed << ", " << least.dialect << ": "
                  << unforeseen(least, inputs, kRuns, ignored).value_or("") << "\n"
                  << textOf(least.lines);
    if (++wrong == kMostShown)
      return;
  }
  std::cout << tally.runs << " runs, " << tally.steps << " steps, " << tally.overflown << " overflows, "
            << tally.abandoned << " not analysed\n";
  EXPECT_GE(tally.runs, programs * kRuns * 95 / 100);
  EXPECT_LE(tally.overflown, tally.runs / 20);
}

} // namespace
} // namespace feedhold::soundness
