// Programs of a run: calls and names resolved over all files.
#include "meaning/cfg/program_set.h"

#include "base/support/check.h"
#include "base/support/parallel.h"

#include <algorithm>
#include <filesystem>
#include <set>

namespace feedhold {

namespace {

bool mayBeginCompensation(const Word &word, const Dialect &dialect) {
  if (word.address() != 'G' || !word.isCode())
    return false;
  const Code *code = word.isNumber() ? codeOf(word, dialect) : nullptr;
  return !word.isNumber() || (code != nullptr && beginsCompensation(code->action));
}

/// The names of `SETVN 500[ABC,DEF]` with the variables that they name.
void addNamesOf(const ProgramFile &file, const NameVariables &statement,
                std::vector<std::pair<std::string, std::uint32_t>> &named) {
  const std::optional<Decimal> first = statement.first ? literalValue(*file.tree, *statement.first) : std::nullopt;
  const std::optional<std::int64_t> number = first ? first->asInteger() : std::nullopt;
  if (!number || *number < 0 || *number >= kFirstNamedVariable)
    return;
  std::string_view rest = file.source->text(statement.names);
  for (auto variable = static_cast<std::uint32_t>(*number); !rest.empty(); ++variable) {
    const std::size_t comma = std::min(rest.find(','), rest.size());
    if (std::string name = comparedName(rest.substr(0, comma)); !name.empty())
      named.emplace_back(std::move(name), variable);
    rest.remove_prefix(std::min(comma + 1, rest.size()));
  }
}

std::optional<std::uint32_t> systemVariableOf(const Dialect &dialect, std::string_view name) {
  for (const VariableRange &range : dialect.variables)
    if (!range.name.empty() && range.first == range.last && comparedName(range.name) == name)
      return range.first;
  return std::nullopt;
}

template <typename T> void sortUnique(std::vector<T> &all) {
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
}

/// A part of the path, which may be written with `\\` on Windows.
std::string_view folderOf(std::string_view path) {
  constexpr std::string_view kSeparators = std::filesystem::path::preferred_separator == '/' ? "/" : "/\\";
  const std::size_t end = path.find_last_of(kSeparators);
  return end == std::string_view::npos ? std::string_view() : path.substr(0, end);
}

/// The index of a written `#[..]` may be that of a common variable: nothing in it is a number of system variables.
bool mayNameCommon(const SyntaxTree &tree, const IndirectVariable &target) {
  const Decimal firstBeyondCommon(1000, 0);
  const std::vector<ExpressionId> parts = subexpressions(tree, target.index);
  return std::none_of(parts.begin(), parts.end(), [&](ExpressionId part) {
    const std::optional<Decimal> value = literalValue(tree, part);
    return value && *value >= firstBeyondCommon;
  });
}

bool mayBeIncremental(const ProgramFile &file) {
  return std::any_of(file.cfg.nodes.begin(), file.cfg.nodes.end(), [](const Node &node) {
    const auto *execute = std::get_if<ExecuteWords>(&node.instruction);
    return execute != nullptr && execute->traits.mayDo(CodeAction::Incremental);
  });
}

/// The block behind which a search for a sequence number begins at the head of the program.
BlockId lastBlockOf(const Program &program) {
  return BlockId(std::max(program.last.index(), program.first.index() + 1) - 1);
}

} // namespace

ProgramSet::ProgramSet(std::vector<ProgramFile> files, CallGraph callGraph, unsigned jobs)
    : files_(std::move(files)), callGraph_(std::move(callGraph)) {
  std::vector<const ProgramModel *> models;
  for (const ProgramFile &each : files_) {
    FEEDHOLD_CHECK(each.file.index() == static_cast<std::size_t>(&each - files_.data()), "files are numbered in order");
    models.push_back(each.model);
    byFolder_[folderOf(each.source->path())].files.push_back(each.file);
  }
  returns_ = returnTargets(models);
  parallelFor(files_.size(), jobs, [&](std::size_t i) {
    ProgramFile &each = files_[i];
    each.cfg = lower(*each.source, *each.tree, *each.model, *each.dialect, returns_);
  });
  for (const ProgramFile &each : files_) {
    findNames(each);
    findModalCallees(each);
    findWritten(each);
    findUses(each);
    if (FilesOfFolder &folder = byFolder_[folderOf(each.source->path())]; !folder.mayBeIncremental)
      folder.mayBeIncremental = mayBeIncremental(each);
  }
  sortUnique(modalCallees_);
  sortUnique(written_);
  const auto less = [](const auto &a, const auto &b) { return a.first < b.first; };
  std::stable_sort(namedNumbers_.begin(), namedNumbers_.end(), less);
  sortUnique(names_);
  for (const ProgramFile &each : files_)
    findMeanings(each);
}

bool ProgramSet::isWrittenInCalled(std::uint32_t variable) const {
  return std::binary_search(written_.begin(), written_.end(), variable);
}

void ProgramSet::findWritten(const ProgramFile &file) {
  for (std::size_t i = 0; i < file.model->programs.size(); ++i) {
    const ProgramId program(i);
    if (!file.model->programs[program].returns && !callGraph_.isCalled({file.file, program}))
      continue;
    for (const VariableUse &use : file.model->variablesOf(program))
      if (use.write && use.number)
        written_.push_back(*use.number);
  }
}

void ProgramSet::findUses(const ProgramFile &file) {
  mayCompensate_ = mayCompensate_ || std::ranges::any_of(file.tree->words, [&](const Word &word) {
                     return mayBeginCompensation(word, *file.dialect);
                   });
  for (const VariableUse &use : file.model->variables) {
    UseCounts &counts = use.number ? uses_[*use.number] : unnumbered_;
    ++(use.write ? counts.writes : counts.reads);
    if (use.number)
      continue;
    const auto *indirect = std::get_if<IndirectVariable>(&file.tree->expressions[use.expression].node);
    unnumbered_.hasIndirect = unnumbered_.hasIndirect || indirect != nullptr;
    if (use.write && indirect != nullptr && !unnumbered_.mayWriteCommon)
      unnumbered_.mayWriteCommon = mayNameCommon(*file.tree, *indirect);
  }
}

UseCounts ProgramSet::usesOf(std::uint32_t variable) const {
  const auto found = uses_.find(variable);
  return found == uses_.end() ? UseCounts() : found->second;
}

bool ProgramSet::mayBeIncrementalInFolderOf(FileId id) const {
  return byFolder_.at(folderOf(file(id).source->path())).mayBeIncremental;
}

void ProgramSet::findModalCallees(const ProgramFile &from) {
  for (std::size_t i = 0; i < from.model->calls.size(); ++i) {
    const CallKind kind = from.model->calls[CallId(i)].kind;
    if (kind != CallKind::Modal && kind != CallKind::ModalEach)
      continue;
    hasModalCalls_ = true;
    const std::vector<Callee> found = candidates(from.file, from.model->calls[CallId(i)]);
    modalCallees_.insert(modalCallees_.end(), found.begin(), found.end());
  }
}

void ProgramSet::findNames(const ProgramFile &file) {
  for (const Statement &statement : file.tree->statements)
    if (const auto *naming = std::get_if<NameVariables>(&statement.node))
      addNamesOf(file, *naming, namedNumbers_);
  if (!file.dialect->grammar.namedParameters)
    return;
  if (!naming_)
    naming_ = file.dialect;
  for (const Expression &expression : file.tree->expressions)
    if (const auto *named = std::get_if<NamedVariable>(&expression.node))
      names_.push_back(comparedName(file.source->text(named->name)));
}

std::span<const FileId> ProgramSet::inFolderOf(FileId id) const {
  return byFolder_.at(folderOf(file(id).source->path())).files;
}

std::optional<Callee> ProgramSet::callee(FileId id, CallId callId) const {
  const ProgramFile &from = file(id);
  const Call &call = from.model->calls[callId];
  switch (call.kind) {
  case CallKind::MacroA:
  case CallKind::ModalCancel:
  case CallKind::External: return std::nullopt;
  case CallKind::Local: return localCallee(id, call);
  case CallKind::Macro:
  case CallKind::Modal:
  case CallKind::ModalEach:
  case CallKind::Code:
  case CallKind::OWord: return entryOf(callGraph_.callee(id, call));
  case CallKind::Subprogram: break;
  }
  const std::optional<Callee> program = entryOf(callGraph_.callee(id, call));
  const std::span<const Jump> jumps = from.model->jumpsIn(call.block, call.block.next());
  const auto start =
      std::find_if(jumps.begin(), jumps.end(), [](const Jump &each) { return each.kind == JumpKind::CallAt; });
  if (!program || start == jumps.end())
    return program;
  // Where the parameter is not known, nor is the start.
  const std::optional<std::uint32_t> number = targetNumber(*start);
  if (!number || from.dialect->switches.sqc != Switch::On)
    return std::nullopt;
  const ProgramFile &to = file(program->file);
  const std::optional<NodeId> label =
      findLabel(to.cfg, *to.model, program->program, *number, lastBlockOf(to.model->programs[program->program]));
  return label ? std::optional(Callee{program->file, *label, program->program}) : std::nullopt;
}

std::vector<Callee> ProgramSet::candidates(FileId file, const Call &call) const {
  std::vector<Callee> callees;
  for (const ProgramRef &program : callGraph_.candidates(file, call))
    callees.push_back(*entryOf(program));
  return callees;
}

std::optional<Callee> ProgramSet::calleeOf(FileId caller, std::uint32_t programNumber) const {
  Call call{CallKind::Macro, ProgramId(0), BlockId(0), WordId(0), std::nullopt, {}, std::nullopt, {}};
  call.callee.number = programNumber;
  return entryOf(callGraph_.callee(caller, call));
}

std::optional<Callee> ProgramSet::entryOf(std::optional<ProgramRef> program) const {
  if (!program)
    return std::nullopt;
  return Callee{program->file, file(program->file).cfg.entryOf(program->program), program->program};
}

std::optional<Callee> ProgramSet::localCallee(FileId id, const Call &call) const {
  const ProgramFile &from = file(id);
  for (const Jump &jump : from.model->jumpsIn(call.block, call.block.next()))
    if (jump.kind == JumpKind::LocalCall && jump.target)
      return Callee{id, arrival(from.cfg, *jump.target, call.block), call.caller};
  return std::nullopt;
}

std::vector<Callee> ProgramSet::candidates(FileId file, const Call &call, std::uint32_t number) const {
  Call named = call;
  named.callee = {number, ""};
  return candidates(file, named);
}

std::vector<Callee> ProgramSet::numbered(FileId file, const Call &call,
                                         const std::function<bool(std::uint32_t)> &isPossible) const {
  std::vector<Callee> all;
  std::set<Callee> known; // a number packed with repeats names the program of another
  for (const std::uint32_t number : callGraph_.numbers())
    if (isPossible(number))
      for (const Callee &callee : candidates(file, call, number))
        if (known.insert(callee).second)
          all.push_back(callee);
  return all;
}

std::vector<LabelledPart> ProgramSet::localParts(FileId id, const Call &call) const {
  const ProgramFile &from = file(id);
  std::set<std::uint32_t> seen;
  std::vector<LabelledPart> parts;
  for (const SequenceNumber &label : from.model->sequenceNumbersOf(call.caller))
    if (seen.insert(label.number).second)
      if (const auto place = findLabel(from.cfg, *from.model, call.caller, label.number, call.block))
        parts.push_back({label.number, {id, *place, call.caller}});
  return parts;
}

bool ProgramSet::startsInside(FileId id, const Call &call) const {
  const std::span<const Jump> jumps = file(id).model->jumpsIn(call.block, call.block.next());
  return std::any_of(jumps.begin(), jumps.end(), [](const Jump &jump) { return jump.kind == JumpKind::CallAt; });
}

std::optional<std::uint32_t> ProgramSet::variableOf(FileId id, Span span) const {
  const std::vector<NamedPlace> &places = places_[id.index()];
  const auto known = std::ranges::lower_bound(places, span.begin, {}, &NamedPlace::begin);
  return known != places.end() && known->begin == span.begin ? known->variable : meaningOf(file(id), span);
}

void ProgramSet::findMeanings(const ProgramFile &file) {
  std::vector<NamedPlace> &places = places_.emplace_back();
  for (const Expression &expression : file.tree->expressions)
    if (const auto *named = std::get_if<NamedVariable>(&expression.node))
      places.push_back({named->name.begin, meaningOf(file, named->name)});
  std::ranges::sort(places, {}, &NamedPlace::begin);
}

std::optional<std::uint32_t> ProgramSet::meaningOf(const ProgramFile &from, Span span) const {
  const std::string name = comparedName(from.source->text(span));
  if (const std::optional<std::uint32_t> system = systemVariableOf(*from.dialect, name))
    return system;
  const auto number = std::lower_bound(namedNumbers_.begin(), namedNumbers_.end(), name,
                                       [](const auto &each, const std::string &wanted) { return each.first < wanted; });
  if (number != namedNumbers_.end() && number->first == name)
    return number->second;
  return from.dialect->grammar.namedParameters ? variableNamed(name) : std::nullopt;
}

std::optional<std::uint32_t> ProgramSet::variableNamed(std::string_view canonical) const {
  if (const auto predefined = naming_ ? predefinedNamed(*naming_, canonical) : std::nullopt)
    return predefined;
  const auto known = std::lower_bound(names_.begin(), names_.end(), canonical);
  if (known == names_.end() || *known != canonical)
    return std::nullopt;
  return kFirstNamedVariable + static_cast<std::uint32_t>(known - names_.begin());
}

bool ProgramSet::usesName(std::string_view canonical) const {
  return std::binary_search(names_.begin(), names_.end(), canonical);
}

std::optional<std::uint32_t> ProgramSet::returnedValue() const {
  return usesName(kReturnedValue) || usesName(kIsValueReturned) ? variableNamed(kReturnedValue) : std::nullopt;
}

std::string ProgramSet::nameOfVariable(std::uint32_t variable) const {
  if (variable == kSkipShare)
    return "#skip";
  if (const PredefinedName *name = naming_ ? findPredefinedName(*naming_, variable) : nullptr)
    return "#<" + std::string(name->row.name) + ">";
  if (variable < kFirstNamedVariable)
    return "#" + std::to_string(variable);
  FEEDHOLD_CHECK(variable - kFirstNamedVariable < names_.size(), "a named variable of another set");
  return "#<" + names_[variable - kFirstNamedVariable] + ">";
}

bool ProgramSet::hasNameFrom(std::uint32_t variable, std::string_view beginning) const {
  return !beginning.empty() && variable >= kFirstNamedVariable && variable - kFirstNamedVariable < names_.size() &&
         names_[variable - kFirstNamedVariable].starts_with(beginning);
}

bool ProgramSet::isInputName(std::uint32_t variable) const {
  return naming_ && hasNameFrom(variable, naming_->inputNames);
}

bool ProgramSet::isSettingName(std::uint32_t variable) const {
  return naming_ && hasNameFrom(variable, naming_->settingNames);
}

bool ProgramSet::isGlobalName(std::uint32_t variable) const {
  return variable >= kFirstNamedVariable && variable - kFirstNamedVariable < names_.size() &&
         names_[variable - kFirstNamedVariable].starts_with('_');
}

bool ProgramSet::isLocalName(std::uint32_t variable) const {
  return variable >= kFirstNamedVariable && variable - kFirstNamedVariable < names_.size() && !isGlobalName(variable);
}

std::vector<std::uint32_t> ProgramSet::localNames() const {
  std::vector<std::uint32_t> numbers;
  for (std::uint32_t i = 0; i < names_.size(); ++i)
    if (isLocalName(kFirstNamedVariable + i))
      numbers.push_back(kFirstNamedVariable + i);
  return numbers;
}

} // namespace feedhold
