// CallGraph: calls resolved over all files of a run.
#include "language/model/call_graph.h"

#include "base/support/check.h"
#include "base/support/text.h"

#include <algorithm>
#include <array>
#include <functional>
#include <unordered_map>

namespace feedhold {

namespace {

/// `O9010`, `9010` as a file name without extension names program 9010.
std::optional<std::uint32_t> numberFromStem(std::string_view stem) {
  if (!stem.empty() && toUpper(stem.front()) == 'O')
    stem.remove_prefix(1);
  if (stem.empty() || stem.size() > 8 || !std::all_of(stem.begin(), stem.end(), isDigit))
    return std::nullopt;
  return static_cast<std::uint32_t>(std::stoul(std::string(stem)));
}

/// A key under which a program is looked up.
std::string keyOf(const ProgramName &name) {
  if (name.isSubroutine)
    return "o" + name.text;
  return name.number ? "#" + std::to_string(*name.number) : "<" + toUpper(name.text);
}

std::string placeOf(const std::string &folder, const ProgramName &name) { return folder + '\n' + keyOf(name); }

bool transfersControl(CallKind kind) {
  switch (kind) {
  case CallKind::Macro:
  case CallKind::Modal:
  case CallKind::ModalEach:
  case CallKind::Subprogram:
  case CallKind::Code:
  case CallKind::OWord: return true;
  case CallKind::ModalCancel:
  case CallKind::MacroA:
  case CallKind::Local:
  case CallKind::External: return false;
  }
  FEEDHOLD_UNREACHABLE("the switch names every kind");
}

bool opensLevel(CallKind kind) { return kind != CallKind::Subprogram; }

/// Places in which a called program is looked for, the nearest first.  Inside a dump of a memory: the folder of the
/// caller, then those that FANUC calls common program folder, MTB dedicated folders and system folder (B-63944EN,
/// program management).
constexpr std::array<std::string_view, 4> kCommonFolders = {"/USER/LIBRARY", "/MTB2", "/MTB1", "/SYSTEM"};
constexpr int kSameFolder = 1 + static_cast<int>(kCommonFolders.size());
constexpr int kFolderNear = kSameFolder + 1; // above or below that of the caller, or a library beside it
constexpr int kOutOfReach = kFolderNear + 1;

int distanceInMemory(std::string_view from, std::string_view to) {
  if (from == to)
    return 0;
  for (std::size_t i = 0; i < kCommonFolders.size(); ++i)
    if (to.find(kCommonFolders[i]) != std::string_view::npos)
      return 1 + static_cast<int>(i);
  return kOutOfReach;
}

/// `shop/sub_programs` for a caller in `shop/main_programs`: folders whose names say that others call what they hold.
bool isLibraryBeside(std::string_view folder, std::string_view caller) {
  constexpr std::array<std::string_view, 5> kNames = {"SUB", "MACRO", "LIB", "COMMON", "CYCLE"};
  const std::size_t slash = folder.rfind('/');
  if (slash == std::string_view::npos || slash != caller.rfind('/') ||
      folder.substr(0, slash) != caller.substr(0, slash))
    return false;
  const std::string name = toUpper(folder.substr(slash + 1));
  return std::any_of(kNames.begin(), kNames.end(),
                     [&name](std::string_view part) { return name.find(part) != std::string::npos; });
}

bool isBelow(std::string_view folder, std::string_view above) {
  return folder.size() > above.size() && folder.starts_with(above) && folder[above.size()] == '/';
}

} // namespace

struct CallGraph::Impl {
  struct ProgramRefHash {
    std::size_t operator()(const ProgramRef &ref) const {
      return std::hash<std::uint64_t>{}((std::uint64_t{ref.file.index()} << 32) ^ ref.program.index());
    }
  };

  struct Edge {
    ProgramRef callee;
    CallKind kind;
  };

  std::vector<ModelledFile> files;
  std::unordered_map<std::uint32_t, std::size_t> slotOf; // FileId -> index in files
  std::unordered_map<std::string, std::vector<ProgramRef>> byName;
  std::unordered_map<std::string, std::vector<ProgramRef>> byPlace;   // folder and name
  std::unordered_map<std::string, std::vector<ProgramRef>> elsewhere; // by the caller's place, where that has none
  std::unordered_map<ProgramRef, std::vector<Edge>, ProgramRefHash> callees;
  std::unordered_map<ProgramRef, std::vector<Caller>, ProgramRefHash> callers;
  std::unordered_map<ProgramRef, std::optional<Depth>, ProgramRefHash> depths;
  std::size_t programCount = 0;
  std::vector<std::uint32_t> numbers; // sorted

  const ModelledFile &file(FileId id) const { return files[slotOf.at(id.index())]; }

  void indexPrograms();
  void indexCalls();
  void indexProgram(const ModelledFile &where, ProgramRef ref, const ProgramName &name);
  void lookElsewhere(ProgramRef from, const ProgramName &name);
  std::vector<ProgramRef> find(ProgramRef from, const ProgramName &name) const;
  std::vector<ProgramRef> nearest(const std::vector<ProgramRef> &among, ProgramRef from, const ProgramName &name,
                                  int farthest) const;
  bool isPacked(FileId file, const Call &call) const;
  bool isFileOf(FileId id, std::string_view label) const;
  std::vector<ProgramRef> candidates(FileId file, const Call &call) const;
  int distance(ProgramRef from, ProgramRef to) const;
  const Program &program(ProgramRef ref) const { return file(ref.file).model->programs[ref.program]; }
  void computeDepths(ProgramRef start);
  std::optional<Depth> depthFromCallees(ProgramRef program) const;
};

void CallGraph::Impl::indexPrograms() {
  for (std::size_t slot = 0; slot < files.size(); ++slot) {
    const ModelledFile &each = files[slot];
    slotOf.emplace(each.file.index(), slot);
    for (std::size_t i = 0; i < each.model->programs.size(); ++i) {
      const ProgramRef ref{each.file, ProgramId(i)};
      const ProgramName &name = each.model->programs[ref.program].name;
      ++programCount;
      if (!name.empty())
        indexProgram(each, ref, name);
      else if (const auto number = numberFromStem(each.stem); number && i == 0)
        indexProgram(each, ref, {number, ""});
    }
  }
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

void CallGraph::Impl::indexProgram(const ModelledFile &where, ProgramRef ref, const ProgramName &name) {
  if (name.number)
    numbers.push_back(*name.number);
  byName[keyOf(name)].push_back(ref);
  byPlace[placeOf(where.folder, name)].push_back(ref);
}

/// How far a control looks for a program: none has the programs of another machine.
int CallGraph::Impl::distance(ProgramRef from, ProgramRef to) const {
  const ModelledFile &caller = file(from.file);
  const ModelledFile &callee = file(to.file);
  if (from.file == to.file)
    return distanceInMemory(program(from).folder, program(to).folder);
  if (caller.folder == callee.folder)
    return kSameFolder;
  const bool isNear = isBelow(caller.folder, callee.folder) || isBelow(callee.folder, caller.folder) ||
                      isLibraryBeside(callee.folder, caller.folder);
  return isNear ? kFolderNear : kOutOfReach;
}

/// The programs of the nearest place.  A subroutine of o-words is found in the caller's own file or in the one named
/// after it (`name.ngc`), wherever that lies.
/// A plant has a program of the same number in each of its folders: first those of the caller's folder are asked, and
/// all others once for each folder and name that is called.
std::vector<ProgramRef> CallGraph::Impl::find(ProgramRef from, const ProgramName &name) const {
  if (name.empty())
    return {};
  const std::string place = placeOf(file(from.file).folder, name);
  if (const auto here = byPlace.find(place); here != byPlace.end())
    if (std::vector<ProgramRef> programs = nearest(here->second, from, name, kSameFolder); !programs.empty())
      return programs;
  if (const auto known = elsewhere.find(place); known != elsewhere.end())
    return known->second;
  const auto found = byName.find(keyOf(name));
  return found == byName.end() ? std::vector<ProgramRef>() : nearest(found->second, from, name, kFolderNear);
}

/// The nearest of them, none beyond the distance `farthest`.
std::vector<ProgramRef> CallGraph::Impl::nearest(const std::vector<ProgramRef> &among, ProgramRef from,
                                                 const ProgramName &name, int farthest) const {
  int nearest = farthest;
  std::vector<ProgramRef> programs;
  for (const ProgramRef &ref : among) {
    int here = distance(from, ref);
    if (name.isSubroutine && ref.file != from.file)
      here = isFileOf(ref.file, name.text) ? std::min(here, kFolderNear) : kOutOfReach;
    if (here < nearest)
      programs.clear();
    if (here <= nearest)
      programs.push_back(ref);
    nearest = std::min(nearest, here);
  }
  return programs;
}

bool CallGraph::Impl::isFileOf(FileId id, std::string_view label) const { return comparedName(file(id).stem) == label; }

bool CallGraph::Impl::isPacked(FileId file, const Call &call) const {
  const ProgramRef caller{file, call.caller};
  return call.packed && find(caller, call.callee).empty() && !find(caller, {call.packed->program, ""}).empty();
}

std::vector<ProgramRef> CallGraph::Impl::candidates(FileId file, const Call &call) const {
  const ProgramName name = isPacked(file, call) ? ProgramName{call.packed->program, ""} : call.callee;
  return find({file, call.caller}, name);
}

/// What callers in one folder find is the same when nothing in that folder has the name.
void CallGraph::Impl::lookElsewhere(ProgramRef from, const ProgramName &name) {
  std::string place = placeOf(file(from.file).folder, name);
  const auto found = byName.find(keyOf(name));
  if (name.empty() || found == byName.end() || byPlace.contains(place) || elsewhere.contains(place))
    return;
  elsewhere.emplace(std::move(place), nearest(found->second, from, name, kFolderNear));
}

void CallGraph::Impl::indexCalls() {
  for (const ModelledFile &each : files)
    for (std::size_t i = 0; i < each.model->calls.size(); ++i) {
      const Call &call = each.model->calls[CallId(i)];
      if (!transfersControl(call.kind))
        continue;
      lookElsewhere({each.file, call.caller}, call.callee);
      for (const ProgramRef &target : candidates(each.file, call)) {
        callees[{each.file, call.caller}].push_back({target, call.kind});
        callers[target].push_back({each.file, CallId(i)});
      }
    }
  for (const ModelledFile &each : files)
    for (std::size_t i = 0; i < each.model->programs.size(); ++i)
      computeDepths({each.file, ProgramId(i)});
}

/// Depth-first with a stack of our own: call chains in hostile input are as long as the file.
void CallGraph::Impl::computeDepths(ProgramRef start) {
  std::unordered_map<ProgramRef, std::size_t, ProgramRefHash> open; // program on the stack -> callees looked at
  std::vector<ProgramRef> stack;
  const auto push = [&](ProgramRef program) {
    stack.push_back(program);
    open.emplace(program, 0);
  };
  if (!depths.contains(start))
    push(start);
  while (!stack.empty()) {
    const ProgramRef program = stack.back();
    const auto edges = callees.find(program);
    std::size_t &next = open[program];
    if (edges == callees.end() || next == edges->second.size()) {
      depths.emplace(program, depthFromCallees(program));
      open.erase(program);
      stack.pop_back();
      continue;
    }
    const ProgramRef callee = edges->second[next++].callee;
    if (!depths.contains(callee) && !open.contains(callee))
      push(callee);
  }
}

/// Absent when a callee is recursive, or is still open: then the call closes a cycle.
std::optional<CallGraph::Depth> CallGraph::Impl::depthFromCallees(ProgramRef program) const {
  Depth depth;
  const auto edges = callees.find(program);
  if (edges == callees.end())
    return depth;
  for (const Edge &edge : edges->second) {
    const auto callee = depths.find(edge.callee);
    if (callee == depths.end() || !callee->second)
      return std::nullopt;
    depth.macro = std::max(depth.macro, callee->second->macro + (opensLevel(edge.kind) ? 1 : 0));
    depth.total = std::max(depth.total, callee->second->total + 1);
  }
  return depth;
}

CallGraph::CallGraph(std::vector<ModelledFile> files) {
  auto impl = std::make_shared<Impl>();
  impl->files = std::move(files);
  impl->indexPrograms();
  impl->indexCalls();
  impl_ = std::move(impl);
}

std::optional<ProgramRef> CallGraph::callee(FileId file, const Call &call) const {
  const std::vector<ProgramRef> programs = candidates(file, call);
  return programs.size() == 1 ? std::optional(programs.front()) : std::nullopt;
}

std::vector<ProgramRef> CallGraph::candidates(FileId file, const Call &call) const {
  return impl_ && transfersControl(call.kind) ? impl_->candidates(file, call) : std::vector<ProgramRef>();
}

bool CallGraph::isFileOf(FileId file, std::string_view label) const { return impl_ && impl_->isFileOf(file, label); }
bool CallGraph::isPacked(FileId file, const Call &call) const { return impl_ && impl_->isPacked(file, call); }

bool CallGraph::reachesEncrypted(FileId file, const Call &call) const {
  const std::vector<ProgramRef> programs = candidates(file, call);
  return std::any_of(programs.begin(), programs.end(),
                     [this](ProgramRef ref) { return impl_->program(ref).isEncrypted; });
}

std::vector<ProgramRef> CallGraph::namesakes(ProgramRef program) const {
  std::vector<ProgramRef> others;
  if (!impl_)
    return others;
  const ModelledFile &file = impl_->file(program.file);
  const auto found = impl_->byPlace.find(placeOf(file.folder, file.model->programs[program.program].name));
  if (found == impl_->byPlace.end())
    return others;
  for (const ProgramRef &ref : found->second)
    if (ref != program && impl_->program(ref).folder == impl_->program(program).folder)
      others.push_back(ref);
  return others;
}

std::vector<CallGraph::Caller> CallGraph::callers(ProgramRef program) const {
  if (!impl_)
    return {};
  const auto found = impl_->callers.find(program);
  return found == impl_->callers.end() ? std::vector<Caller>() : found->second;
}

std::optional<CallGraph::Depth> CallGraph::depthFrom(ProgramRef program) const {
  if (!impl_)
    return Depth{};
  const auto found = impl_->depths.find(program);
  return found == impl_->depths.end() ? std::optional(Depth{}) : found->second;
}

/// Breadth-first from the program back to itself: the shortest cycle.
std::vector<ProgramRef> CallGraph::cycleThrough(ProgramRef program) const {
  if (!impl_)
    return {};
  std::unordered_map<ProgramRef, ProgramRef, Impl::ProgramRefHash> reachedFrom;
  std::vector<ProgramRef> queue = {program};
  for (std::size_t i = 0; i < queue.size(); ++i) {
    const auto edges = impl_->callees.find(queue[i]);
    if (edges == impl_->callees.end())
      continue;
    for (const Impl::Edge &edge : edges->second) {
      if (edge.callee == program) {
        std::vector<ProgramRef> cycle = {queue[i]};
        while (cycle.back() != program)
          cycle.push_back(reachedFrom.at(cycle.back()));
        std::reverse(cycle.begin(), cycle.end());
        return cycle;
      }
      if (reachedFrom.emplace(edge.callee, queue[i]).second)
        queue.push_back(edge.callee);
    }
  }
  return {};
}

const ProgramModel &CallGraph::model(FileId file) const {
  FEEDHOLD_CHECK(impl_, "model() asked of an empty call graph");
  return *impl_->file(file).model;
}

std::size_t CallGraph::programCount() const { return impl_ ? impl_->programCount : 0; }

const std::vector<std::uint32_t> &CallGraph::numbers() const {
  static const std::vector<std::uint32_t> none;
  return impl_ ? impl_->numbers : none;
}

} // namespace feedhold
