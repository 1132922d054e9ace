// Rule: one claim about a program, its page, and the function that looks for it.
//
// A rule is one .cpp and one .md in rules/<group>/ and one line in rules/rules.def.  It names what it wants to see
// (blocks, words of some addresses, statements, ..) and is called for each; it guards, guards, reports.
#pragma once

#include "base/diag/diagnostic.h"
#include "base/source/source_file.h"
#include "inference/absint/flow_facts.h"
#include "language/contract/contract.h"
#include "language/model/block_facts.h"
#include "language/model/call_graph.h"
#include "language/model/model.h"

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace feedhold {

enum class Category {
  Syntax,
  Structure,
  Expression,
  Variable,
  Alarm,
  Word,
  Call,
  Comment,
  Suppression,
  Flow,
  Motion,
  Contract
};
std::string_view nameOf(Category category);

/// What findings of a rule that say the same have in common.
enum class CauseScope : std::uint8_t {
  SameText,  // the same file, or the same text of the line
  OneFolder, // what the folder lacks: a program, a code of the machine
};

struct RuleInfo {
  std::string_view name; // kebab-case, reads well after "allow"
  Category category;
  Severity severity;
  std::string_view summary; // one sentence, the first of the page
  /// Suppressions and settings may still use it: programs that are released do not change with a name.
  std::string_view formerName = {};
  CauseScope cause = CauseScope::SameText;
};
bool hasName(const RuleInfo &rule, std::string_view name);

/// All that a rule may look at: one file, its control, and the other files of the run.
struct FileContext {
  FileId file;
  const SourceFile &source;
  const Dialect &dialect; // with the switches of the configuration
  const SyntaxTree &tree;
  const ProgramModel &model;
  const CallGraph &callGraph;
  const ProgramSet *programs = nullptr;                 // when some rule asks for the flow
  std::span<const FileContracts *const> contracts = {}; // by FileId; may be empty
  /// The text that findings are about: the program, or a file with its contracts (`source` is that file then).
  ContractSourceId contractSource = kProgramText;
  /// Of the dialect, made once for all rules and programs; null: a rule that needs one makes its own.
  std::shared_ptr<const ModalTable> modes = nullptr;

  std::string_view text(Span span) const { return source.text(span); }
  /// Null: the program has no clause, or contracts were not read.
  const Contract *contractOf(ProgramRef program) const {
    return program.file.index() < contracts.size() ? contracts[program.file.index()]->of(program.program) : nullptr;
  }
  /// "`#510`": program text for a message, blanks at the ends cut, a long one shortened.
  std::string quoted(Span span) const;
};

/// A finding before suppressions and before it knows its fingerprint.
struct RawFinding {
  const RuleInfo *rule;
  Severity severity;
  Diagnostic diagnostic;
};

/// What one rule found in one file.  Beyond kMostKept findings are only counted: a program of megabytes that is wrong
/// in every block would fill the memory with what nobody reads.
struct RuleFindings {
  static constexpr std::size_t kMostKept = 100'000;
  std::vector<RawFinding> kept;
  std::size_t dropped = 0;
};

/// Where a rule leaves what it found.
class Reporter {
public:
  Reporter(const RuleInfo &rule, RuleFindings &sink) : rule_(&rule), sink_(&sink) {}
  void report(Diagnostic diagnostic) const;
  void report(Diagnostic diagnostic, Severity severity) const;

private:
  const RuleInfo *rule_;
  RuleFindings *sink_;
};

/// Kinds of expression nodes, one bit for each alternative of Expression::node.
using NodeSet = std::uint16_t;
inline constexpr NodeSet kAllNodes = 0xffff;

/// The set of some kinds: `nodeSet<BinaryOperation, FunctionCall>()`.
template <typename... Kinds> consteval NodeSet nodeSet() {
  const auto bitOf = []<typename Kind, typename... All>(std::in_place_type_t<Kind>, std::variant<All...> *) {
    NodeSet bit = 1;
    NodeSet found = 0;
    ((found = std::is_same_v<Kind, All> ? bit : found, bit = static_cast<NodeSet>(bit << 1)), ...);
    return found;
  };
  return static_cast<NodeSet>(
      (bitOf(std::in_place_type<Kinds>, static_cast<decltype(Expression::node) *>(nullptr)) | ...));
}

/// A rule that looks on while a program is analysed, and reports at the end.  It is asked only about analyses that came
/// to their end.
class FlowRule : public FlowWatch {
public:
  virtual void report(const FlowFacts &, const FileContext &, const Reporter &) = 0;
};

/// Of which runs a rule that asks for the flow is told, where the program has a contract that speaks of its entry.
enum class FlowRuns : std::uint8_t {
  Allowed, // that the contract allows: for what goes wrong in some run
  All,     // for what never happens: programs guard against calls outside of their contract
};

/// What a rule wants to be called for.  A null pointer: nothing.
struct RuleHooks {
  void (*issue)(const SyntaxIssue &, const FileContext &, const Reporter &) = nullptr;
  std::span<const SyntaxIssueKind> issueKinds = {}; // issue is called for these
  void (*contract)(const ContractIssue &, const FileContext &, const Reporter &) = nullptr;
  std::span<const ContractIssueKind> contractKinds = {}; // contract is called for these
  void (*file)(const FileContext &, const Reporter &) = nullptr;
  void (*program)(ProgramId, const FileContext &, const Reporter &) = nullptr;
  void (*block)(BlockId, const FileContext &, const Reporter &) = nullptr; // every block that the control reads
  void (*word)(const Word &, BlockId, const FileContext &, const Reporter &) = nullptr;
  std::string_view wordAddresses = {}; // word is called for these addresses only
  void (*statement)(const Statement &, BlockId, const FileContext &, const Reporter &) = nullptr; // nested ones too
  void (*expression)(ExpressionId, BlockId, const FileContext &, const Reporter &) = nullptr;
  NodeSet expressionNodes = kAllNodes; // expression is called for these
  void (*jump)(const Jump &, const FileContext &, const Reporter &) = nullptr;
  void (*call)(CallId, const FileContext &, const Reporter &) = nullptr;
  void (*variable)(const VariableUse &, const FileContext &, const Reporter &) = nullptr;
  void (*comment)(const Comment &, BlockId, const FileContext &, const Reporter &) = nullptr;
  /// Once for each program of the file, when its analysis has come to its end.
  void (*flow)(const FlowFacts &, const FileContext &, const Reporter &) = nullptr;
  /// The same for a rule that has to look on.
  std::unique_ptr<FlowRule> (*watch)(ProgramId, const FileContext &) = nullptr;
  FlowRuns flowRuns = FlowRuns::Allowed;
  bool asksFlow() const { return flow != nullptr || watch != nullptr; }
};

struct Rule {
  RuleInfo info;
  RuleHooks hooks;
};

} // namespace feedhold
