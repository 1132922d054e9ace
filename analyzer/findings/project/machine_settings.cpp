#include "findings/project/machine_settings.h"

#include "base/source/path_text.h"
#include "base/support/text.h"
#include "findings/project/config.h"
#include "language/model/word_habits.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <tuple>

namespace feedhold {

namespace {

// Evidence that a slip, or a slip and its copy, does not reach.
constexpr std::size_t kFewestLengths = 20; // without a point
constexpr std::size_t kFewestOfNearlyAll = 10;
constexpr std::size_t kFewestOfHalf = 3; // of whole lengths
constexpr std::size_t kShare = 5;        // one of so many lengths has no point; one of so many of nearly all has one
constexpr Decimal kLongest(1000, 0);     // mm: a machinist who means least increments writes more
constexpr std::size_t kFewestBlocks = 3;
constexpr std::size_t kFewestFiles = 2;
constexpr std::uint32_t kFirstSystemVariable = 1000;
constexpr std::size_t kProvenPrograms = 10;    // a control stops at a slip in the first run: so many do not keep it
constexpr std::uint16_t kLastShortCode = 9999; // in tenths; `G1543` may be two codes without the letter between them

/// How often, and in how many files.
struct Uses {
  std::size_t count = 0;
  std::set<const ProjectFile *> files;

  void add(const ProjectFile &file) {
    ++count;
    files.insert(&file);
  }
  bool isHabit() const { return count >= kFewestBlocks && files.size() >= kFewestFiles; }
};

struct Machine {
  std::string folder;
  std::vector<std::shared_ptr<ProjectFile>> files;

  const Dialect &dialect() const { return *files.front()->dialect; }
};

/// Found: the setting, as it is put into the switches and as it is told.
struct Found {
  std::string table, line, evidence;
};

template <typename Visit> void forEachBlock(const Machine &machine, Visit visit) {
  for (const auto &file : machine.files)
    for (std::size_t i = 0; i < file->tree.blockCount(); ++i)
      visit(*file, BlockId(i));
}

/// Calculator-type decimal point input: `X32` is 32 mm.
std::optional<Found> inferDpi(const Machine &machine, Switches &switches) {
  std::size_t all = 0, without = 0, wholeWith = 0, isLong = 0;
  for (const auto &file : machine.files) {
    const WrittenLengths lengths = lengthsOf(file->tree, *file->dialect);
    all += lengths.withPoint + lengths.withoutPoint.size();
    without += lengths.withoutPoint.size();
    wholeWith += lengths.wholeWithPoint;
    isLong += static_cast<std::size_t>(
        std::count_if(lengths.withoutPoint.begin(), lengths.withoutPoint.end(), [&](WordId id) {
          const Decimal value = file->tree.words[id].number();
          return value >= kLongest || value <= kLongest.negated();
        }));
  }
  const bool areNearlyAll = without >= kFewestOfNearlyAll && (all - without) * kShare <= all;
  // Fractions need their point either way: whoever leaves it out of every other whole number does not count in
  // increments, also in a short program.
  const bool areHalf = without >= kFewestOfHalf && without >= wholeWith && without * kShare >= all;
  const bool isHabit = areNearlyAll || areHalf || (without >= kFewestLengths && without * kShare >= all);
  if (switches.dpi != Switch::Unknown || !isHabit || isLong * kShare > without)
    return std::nullopt;
  switches.dpi = Switch::On;
  return Found{"switches", "dpi = true", fmt::format("{} of {} lengths have no decimal point", without, all)};
}

std::optional<Found> inferCir(const Machine &machine, Switches &switches) {
  if (switches.cir != Switch::Unknown || !machine.dialect().hasFanucParameters)
    return std::nullopt;
  Uses arcs;
  forEachBlock(machine, [&](const ProjectFile &file, BlockId block) {
    if (arcWithoutCentre(file.tree, block, *file.dialect))
      arcs.add(file);
  });
  if (!arcs.isHabit())
    return std::nullopt;
  switches.cir = Switch::Off;
  return Found{"switches", "cir = false",
               fmt::format("{} arcs in {} programs have neither R nor I J K", arcs.count, arcs.files.size())};
}

std::optional<Found> inferM3b(const Machine &machine, Switches &switches) {
  if (switches.m3b != Switch::Unknown)
    return std::nullopt;
  Uses blocks;
  forEachBlock(machine, [&](const ProjectFile &file, BlockId block) {
    const std::size_t codes = mCodesOf(file.tree, block).count;
    if (codes > 1 && codes <= file.dialect->limits.mCodes)
      blocks.add(file);
  });
  if (!blocks.isHabit())
    return std::nullopt;
  switches.m3b = Switch::On;
  return Found{"switches", "m3b = true",
               fmt::format("{} blocks in {} programs have several M codes", blocks.count, blocks.files.size())};
}

std::optional<Found> inferVariables(const Machine &machine, Switches &switches) {
  if (!switches.buildersVariables.empty())
    return std::nullopt;
  std::map<std::uint32_t, Uses> unknown;
  for (const auto &file : machine.files)
    for (const VariableUse &use : file->model.variables)
      if (use.number && *use.number >= kFirstSystemVariable && *use.number < kFirstNamedVariable &&
          !findVariable(*file->dialect, *use.number))
        unknown[*use.number].add(*file);
  std::vector<std::string> numbers;
  std::set<const ProjectFile *> files;
  for (const auto &[number, uses] : unknown) {
    if (!uses.isHabit())
      continue;
    switches.buildersVariables.push_back(buildersVariable(number, number));
    numbers.push_back(std::to_string(number));
    files.insert(uses.files.begin(), uses.files.end());
  }
  if (numbers.empty())
    return std::nullopt;
  return Found{"", fmt::format("builders-variables = [{}]", fmt::join(numbers, ", ")),
               fmt::format("{} programs use variables that only this machine can have", files.size())};
}

/// The block and the one before as they are written: words but N and O, and statements.
std::string surroundingsOf(const ProjectFile &file, BlockId block) {
  std::string text;
  const auto add = [&](BlockId id) {
    for (const Word &word : file.tree.wordsOf(id))
      if (word.address() != 'N' && word.address() != 'O')
        text += toUpper(file.source.text(word.span())) + ' ';
    for (const Statement &statement : file.tree.statementsOf(id))
      text += toUpper(file.source.text(statement.span)) + ' ';
    text += '\n';
  };
  if (block.index() > 0)
    add(BlockId(block.index() - 1));
  add(block);
  return text;
}

/// The G codes of a machine: those that the control has, and the others with the places where they stand.
struct WrittenCodes {
  struct Foreign {
    Uses uses;
    std::set<std::string> surroundings;
  };
  std::set<std::string> known; // `G01`
  std::map<CodeName, Foreign> foreign;
};

/// With two digits at least, so that `G9` and `G90` are as near as they look.
std::string twoDigitName(std::uint16_t tenths) {
  std::string name = textOf(CodeName{'G', tenths});
  return tenths < 100 ? name.insert(1, "0") : name;
}

WrittenCodes codesOf(const Machine &machine) {
  WrittenCodes codes;
  forEachBlock(machine, [&](const ProjectFile &file, BlockId block) {
    for (const Word &word : file.tree.wordsOf(block)) {
      const auto tenths = word.address() == 'G' && word.isCode() ? word.tenths() : std::nullopt;
      if (!tenths)
        continue;
      if (hasGCode(*file.dialect, *tenths)) {
        codes.known.insert(twoDigitName(*tenths));
      } else if (*tenths <= kLastShortCode &&
                 file.source.text(word.span()).find_first_of(" \t") == std::string_view::npos) {
        WrittenCodes::Foreign &code = codes.foreign[{'G', *tenths}];
        code.uses.add(file);
        if (code.surroundings.size() < 2) // more tell no more
          code.surroundings.insert(surroundingsOf(file, block));
      }
    }
  });
  return codes;
}

/// `G900` where G90 is used.  Where the code stands in copies of one place only, any code of the control may be meant.
bool mayBeSlip(const CodeName &name, const WrittenCodes &codes, const Dialect &dialect) {
  std::set<std::string> meant = codes.known;
  if (codes.foreign.at(name).surroundings.size() == 1)
    for (const Code &code : dialect.gCodes)
      meant.insert(twoDigitName(code.tenths));
  const std::vector<std::string_view> candidates(meant.begin(), meant.end());
  return nearestWord(twoDigitName(name.tenths), candidates).has_value();
}

std::optional<Found> inferCodes(const Machine &machine, Switches &switches) {
  if (!switches.buildersCodes.empty())
    return std::nullopt;
  const WrittenCodes codes = codesOf(machine);
  std::vector<std::string> names;
  std::set<const ProjectFile *> files;
  for (const auto &[name, code] : codes.foreign) {
    const auto &users = code.uses.files;
    if (!code.uses.isHabit() || (users.size() < kProvenPrograms && mayBeSlip(name, codes, machine.dialect())))
      continue;
    switches.buildersCodes.push_back(name);
    names.push_back(fmt::format("\"{}\"", textOf(name)));
    files.insert(users.begin(), users.end());
  }
  if (names.empty())
    return std::nullopt;
  return Found{"", fmt::format("builders-codes = [{}]", fmt::join(names, ", ")),
               fmt::format("{} programs use G codes that only this machine can have", files.size())};
}

std::vector<Machine> machinesOf(std::span<const std::shared_ptr<ProjectFile>> files) {
  std::map<std::tuple<std::string, std::string_view, std::string>, Machine> machines;
  for (const auto &file : files) {
    if (!file)
      continue;
    std::string folder = pathText(std::filesystem::path(file->shown).parent_path());
    // Files with different settings of the configuration are kept apart.
    Machine &machine = machines[{folder, file->dialect->id, textOf(file->dialect->switches)}];
    machine.folder = std::move(folder);
    machine.files.push_back(file);
  }
  std::vector<Machine> result;
  for (auto &[key, machine] : machines)
    result.push_back(std::move(machine));
  return result;
}

} // namespace

std::vector<InferredSetting> inferMachineSettings(std::span<const std::shared_ptr<ProjectFile>> files) {
  std::vector<InferredSetting> all;
  for (const Machine &machine : machinesOf(files)) {
    Switches switches = machine.dialect().switches;
    const std::size_t before = all.size();
    for (const auto infer : {inferDpi, inferCir, inferM3b, inferVariables, inferCodes})
      if (std::optional<Found> found = infer(machine, switches))
        all.push_back({machine.folder, machine.dialect().id, std::move(found->table), std::move(found->line),
                       std::move(found->evidence)});
    if (all.size() == before)
      continue;
    for (const auto &file : machine.files) {
      auto dialect = std::make_shared<Dialect>(*file->dialect);
      dialect->switches = switches;
      file->dialect = std::move(dialect);
    }
  }
  return all;
}

} // namespace feedhold
