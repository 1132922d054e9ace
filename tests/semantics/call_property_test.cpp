// Random programs that call each other: the machine counts what arithmetic says, the analysis of ranges contains it,
// and the proof of it is no refutation.  Repeated calls, repeated modal calls and calls within them, over two files;
// and for o-words, `repeat` in and around calls of subroutines in another file.
#include "dialects/registry.h"
#include "inference/absint/analysis.h"
#include "language/contract/contract.h"
#include "language/parse/parse.h"
#include "meaning/machine/machine.h"
#include "proof/prove/prove.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <memory>
#include <random>

namespace feedhold {
namespace {

constexpr std::uint32_t kCounted = 100;

/// A few files of one control, loaded.
class Files {
public:
  Files(std::string_view dialect, const std::vector<std::string> &texts)
      : dialect_(*findDialect(allDialects(), dialect)) {
    std::vector<ProgramFile> files;
    std::vector<ModelledFile> names;
    for (std::size_t i = 0; i < texts.size(); ++i) {
      parts_.push_back(std::make_unique<Part>(texts[i], dialect_, i));
      const Part &part = *parts_.back();
      files.push_back({FileId(i), &part.source, &part.tree, &part.model, &dialect_});
      names.push_back({FileId(i), "", nameOf(i), &part.model});
    }
    set_ = std::make_unique<ProgramSet>(std::move(files), CallGraph(std::move(names)));
  }
  const ProgramSet &set() const { return *set_; }
  Callee main() const { return {FileId(0), set_->file(FileId(0)).cfg.entryOf(ProgramId(0)), ProgramId(0)}; }
  FileContracts contracts() const {
    const Part &part = *parts_.front();
    return readContracts(part.source, part.tree, part.model, dialect_);
  }

private:
  /// A control finds the subroutine `o<s2>` in the file of that name.
  static std::string nameOf(std::size_t file) { return fmt::format("s{}", file); }
  struct Part {
    Part(const std::string &text, const Dialect &dialect, std::size_t index)
        : source(SourceFile::fromText(nameOf(index) + ".ngc", text)), tree(parse(source, dialect)),
          model(resolve(source, tree, dialect)) {}
    SourceFile source;
    SyntaxTree tree;
    ProgramModel model;
  };
  const Dialect &dialect_;
  std::vector<std::unique_ptr<Part>> parts_;
  std::unique_ptr<ProgramSet> set_;
};

/// What one of several programs does; `calls` lead to programs with higher numbers alone.
struct Item {
  enum class Kind : std::uint8_t { Count, Move, Subprogram, Macro, Modal, Repeat };
  Kind kind;
  int program = 0;
  int times = 1;
  std::vector<Item> inside = {}; // of Modal: what stands before its G67; of Repeat: the body
};
using Programs = std::vector<std::vector<Item>>;

class Draw {
public:
  explicit Draw(unsigned seed) : random_(seed) {}
  int below(int end) { return static_cast<int>(random_() % static_cast<unsigned>(end)); }

  Programs programs(bool oWords) {
    Programs all(4);
    for (int program = 0; program < 4; ++program)
      all[static_cast<std::size_t>(program)] = items(program, oWords, 0);
    return all;
  }

private:
  std::vector<Item> items(int program, bool oWords, int depth) {
    std::vector<Item> all;
    for (int i = 1 + below(3); i > 0; --i)
      all.push_back(item(program, oWords, depth));
    return all;
  }
  Item item(int program, bool oWords, int depth) {
    using Kind = Item::Kind;
    const bool mayCall = program < 3;
    const int called = mayCall ? program + 1 + below(3 - program) : 0;
    switch (below(depth > 1 ? 2 : 6)) {
    case 0: return {Kind::Count};
    case 1: return oWords ? Item{Kind::Count} : Item{Kind::Move};
    case 2:
    case 3:
      if (oWords)
        return {Kind::Repeat, 0, below(3), items(program, oWords, depth + 1)};
      return mayCall ? Item{below(2) ? Kind::Subprogram : Kind::Macro, called, below(4)} : Item{Kind::Count};
    default:
      if (!mayCall)
        return {Kind::Count};
      if (oWords)
        return {Kind::Subprogram, called};
      return {Kind::Modal, called, 1 + below(2), items(program, oWords, depth + 1)};
    }
  }
  std::mt19937 random_;
};

/// By arithmetic, without any of the engine.
class Expected {
public:
  explicit Expected(const Programs &programs) : programs_(programs) {}
  int run() {
    program(0, std::nullopt);
    return count_;
  }

private:
  /// `usable`: how many of the modal calls the movements of the program make.
  void program(int number, std::optional<std::size_t> usable) {
    items(programs_[static_cast<std::size_t>(number)], usable);
  }
  void items(const std::vector<Item> &all, std::optional<std::size_t> limit) {
    for (const Item &each : all)
      one(each, limit);
  }
  void one(const Item &item, std::optional<std::size_t> limit) {
    switch (item.kind) {
    case Item::Kind::Count: ++count_; break;
    case Item::Kind::Move: move(limit); break;
    case Item::Kind::Repeat:
      for (int i = 0; i < item.times; ++i)
        items(item.inside, limit);
      break;
    case Item::Kind::Subprogram:
    case Item::Kind::Macro:
      for (int i = 0; i < item.times; ++i)
        program(item.program, limit);
      break;
    case Item::Kind::Modal:
      modal_.push_back(&item);
      items(item.inside, limit);
      modal_.pop_back();
      break;
    }
  }
  void move(std::optional<std::size_t> limit) {
    const std::size_t usable = std::min(limit.value_or(modal_.size()), modal_.size());
    if (usable == 0)
      return;
    const Item &call = *modal_[usable - 1];
    for (int i = 0; i < call.times; ++i)
      program(call.program, usable - 1);
  }
  const Programs &programs_;
  std::vector<const Item *> modal_;
  int count_ = 0;
};

class FanucText {
public:
  std::string of(const Programs &programs, std::size_t parity, int expected) {
    std::string text;
    for (std::size_t i = parity; i < programs.size(); i += 2) {
      text += fmt::format("O{}\n", i + 1);
      if (i == 0)
        text += fmt::format("(@ENSURE #100 EQ {})\n#100=0\n", expected);
      items(programs[i], text);
      text += i == 0 ? "M30\n" : "M99\n";
    }
    return text;
  }

private:
  void items(const std::vector<Item> &all, std::string &text) {
    for (const Item &item : all)
      switch (item.kind) {
      case Item::Kind::Count: text += "#100=#100+1\n"; break;
      case Item::Kind::Move: text += "G0X1.\n"; break;
      case Item::Kind::Subprogram: text += fmt::format("M98P{}L{}\n", item.program + 1, item.times); break;
      case Item::Kind::Macro: text += fmt::format("G65P{}L{}A1.\n", item.program + 1, item.times); break;
      case Item::Kind::Modal:
        text += fmt::format("G66P{}L{}B2.\n", item.program + 1, item.times);
        items(item.inside, text);
        text += "G67\n";
        break;
      case Item::Kind::Repeat: break;
      }
  }
};

class OWordText {
public:
  /// Each subroutine in a file of its own.
  std::vector<std::string> of(const Programs &programs) {
    std::vector<std::string> texts;
    for (std::size_t i = 0; i < programs.size(); ++i) {
      std::string text = i == 0 ? "#100=0\n" : fmt::format("o<s{}> sub\n", i);
      items(programs[i], text);
      texts.push_back(text + (i == 0 ? "m2\n" : fmt::format("o<s{}> endsub\n", i)));
    }
    return texts;
  }

private:
  void items(const std::vector<Item> &all, std::string &text) {
    for (const Item &item : all)
      if (item.kind == Item::Kind::Repeat) {
        const int label = ++label_;
        text += fmt::format("o{} repeat [{}]\n", label, item.times);
        items(item.inside, text);
        text += fmt::format("o{} endrepeat\n", label);
      } else if (item.kind == Item::Kind::Subprogram) {
        text += fmt::format("o<s{}> call\n", item.program);
      } else {
        text += "#100=[#100+1]\n";
      }
  }
  int label_ = 0;
};

class CountAtEnd : public AnalysisVisitor {
public:
  void visit(Place, const AbstractState &, std::span<const Place>) override {}
  void ended(Place, PathEnd end, const AbstractState &state) override {
    if (end != PathEnd::Ends)
      return;
    const AbstractValue *value = state.variables.find(kCounted);
    seen.push_back(value ? *value : AbstractValue::any());
  }
  std::vector<AbstractValue> seen;
};

/// False: calls are nested too deep.
bool isCounted(const Files &files, int expected, const std::string &text) {
  const RunResult result = run(files.set(), files.main(), {.fuel = 1'000'000});
  if (result.end == RunEnd::Alarm) {
    EXPECT_TRUE(result.alarm == AlarmKind::MacroNesting || result.alarm == AlarmKind::SubprogramNesting) << text;
    return false;
  }
  EXPECT_TRUE(result.end == RunEnd::M30 || result.end == RunEnd::M02) << nameOf(result.end) << "\n" << text;
  const ConcreteValue *value = result.state.variables.find(kCounted);
  EXPECT_TRUE(value && value->number == expected) << (value ? value->number : -1) << ", not " << expected << "\n"
                                                  << text;

  Analysis analysis(files.set());
  CountAtEnd count;
  analysis.walk(files.main(), analysis.entryState(files.main()), count);
  EXPECT_FALSE(analysis.gaveUp()) << text;
  EXPECT_TRUE(
      std::any_of(count.seen.begin(), count.seen.end(),
                  [&](const AbstractValue &each) { return each.mayBeNumber() && each.number().contains(expected); }))
      << expected << "\n"
      << text;
  return true;
}

TEST(Calls, RepeatedAndModal) {
  int counted = 0;
  int proved = 0;
  for (unsigned seed = 1; seed <= 120; ++seed) {
    const Programs programs = Draw(seed).programs(false);
    const int expected = Expected(programs).run();
    if (expected > 300)
      continue;
    const std::vector<std::string> texts{FanucText().of(programs, 0, expected), FanucText().of(programs, 1, expected)};
    const std::string text = texts[0] + "----\n" + texts[1];
    const Files files("fanuc-30i", texts);
    SCOPED_TRACE(fmt::format("seed {}", seed));
    if (!isCounted(files, expected, text))
      continue;
    ++counted;
    const FileContracts contracts = files.contracts();
    for (const prove::Obligation &row :
         prove::prove(files.set(), files.main(), &contracts,
                      {.only = {prove::ObligationKind::Ensures}, .guards = prove::InferGuards::No})
             .obligations) {
      EXPECT_NE(row.verdict, prove::Verdict::Refuted) << text;
      EXPECT_NE(row.verdict, prove::Verdict::Unreachable) << text;
      proved += prove::holds(row.verdict) ? 1 : 0;
    }
  }
  EXPECT_GT(counted, 40);
  EXPECT_GT(proved, counted / 2);
}

TEST(Calls, RepeatsOfOWords) {
  int counted = 0;
  for (unsigned seed = 1; seed <= 120; ++seed) {
    const Programs programs = Draw(seed).programs(true);
    const int expected = Expected(programs).run();
    const std::vector<std::string> texts = OWordText().of(programs);
    SCOPED_TRACE(fmt::format("seed {}", seed));
    if (expected <= 5000 &&
        isCounted(Files("linuxcnc", texts), expected, fmt::format("{}", fmt::join(texts, "----\n"))))
      ++counted;
  }
  EXPECT_GT(counted, 80);
}

} // namespace
} // namespace feedhold
