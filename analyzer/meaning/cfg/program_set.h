// ProgramSet: all programs of a run with their graphs: where a call leads, and what variables are called.
#pragma once

#include "language/model/call_graph.h"
#include "meaning/cfg/cfg.h"

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

namespace feedhold {

/// One file of a run, from its text to its graph.  The parts outlive the set; `file` is the place in the list.
struct ProgramFile {
  FileId file;
  const SourceFile *source;
  const SyntaxTree *tree;
  const ProgramModel *model;
  const Dialect *dialect;
  Cfg cfg = {};
};

/// A node of one file.
struct Place {
  FileId file;
  NodeId node;
  friend auto operator<=>(const Place &, const Place &) = default;
};

/// Where a call leads.
struct Callee {
  FileId file;
  NodeId entry;
  ProgramId program; // in which a search for a sequence number takes place
  friend auto operator<=>(const Callee &, const Callee &) = default;
};

/// What a local call (M97) with a computed number may enter.
struct LabelledPart {
  std::uint32_t number;
  Callee callee;
};

/// How often the programs of all files use something.
struct UseCounts {
  std::uint32_t reads = 0;
  std::uint32_t writes = 0;
};

/// Of variables without a number of their own in the text: `#[#1+100]`, `#<name>`.
struct UnnumberedUses : UseCounts {
  bool hasIndirect = false;    // `#[..]`
  bool mayWriteCommon = false; // the index of one that is written has no part of 1000 or more
};

/// Names of variables that are no numbers (`#<depth>`): from here on in the numbering of variables, so that every
/// variable is one 32-bit number.
inline constexpr std::uint32_t kFirstNamedVariable = 0x80000000;
/// No variable: its readings say how far skip moves (G31, G38.2) go before their signal comes, each a share of its way.
/// 1: no signal comes.
inline constexpr std::uint32_t kSkipShare = 0xDFFFFFFF;

/// Names of what calls return, and of whether they have returned something.
inline constexpr std::string_view kReturnedValue = "_value", kIsValueReturned = "_value_returned";

class ProgramSet {
public:
  /// Lowers the files; the call graph is over the same files.
  ProgramSet(std::vector<ProgramFile> files, CallGraph callGraph, unsigned jobs = 1);

  const ProgramFile &file(FileId file) const { return files_[file.index()]; }
  std::size_t size() const { return files_.size(); }
  /// The files in the folder of the file, itself included, in order.
  std::span<const FileId> inFolderOf(FileId file) const;
  const CallGraph &callGraph() const { return callGraph_; }
  const Node &node(Place place) const { return file(place.file).cfg.nodes[place.node]; }

  /// Absent when the program is in none of the files, its number is computed, its start (Q of M98, P of M97) is missing
  /// or not known, or the call transfers no control (G67, Macro A).
  std::optional<Callee> callee(FileId file, CallId call) const;
  /// The programs that a call may enter: several where their number is given twice.
  std::vector<Callee> candidates(FileId file, const Call &call) const;
  /// The same of a call whose number is computed, and is this one.
  std::vector<Callee> candidates(FileId file, const Call &call, std::uint32_t number) const;
  /// The programs that a call with a computed number may enter, where that may be one of the numbers given.
  std::vector<Callee> numbered(FileId file, const Call &call,
                               const std::function<bool(std::uint32_t)> &isPossible) const;
  /// The parts of the calling program that M97 may call: one for each sequence number, as the search from the call
  /// finds it.
  std::vector<LabelledPart> localParts(FileId file, const Call &call) const;
  /// The call names the sequence number at which it starts its program (Q of M98).
  bool startsInside(FileId file, const Call &call) const;
  /// As callee, for a number that is known only when the call is made.
  std::optional<Callee> calleeOf(FileId caller, std::uint32_t programNumber) const;
  /// Some program that others call, or that returns to a caller, assigns to the variable by its number.
  bool isWrittenInCalled(std::uint32_t variable) const;
  /// By the number that stands in the text.
  UseCounts usesOf(std::uint32_t variable) const;
  const UnnumberedUses &unnumberedUses() const { return unnumbered_; }
  /// Some program in the folder of the file may have G91.
  bool mayBeIncrementalInFolderOf(FileId file) const;
  /// Some program may begin cutter compensation: it has G41 or its kin, or a computed G code.
  bool mayCompensate() const { return mayCompensate_; }
  /// What the modal calls of all programs call.
  const std::vector<Callee> &modalCallees() const { return modalCallees_; }
  /// Some program begins a modal call.
  bool hasModalCalls() const { return hasModalCalls_; }
  /// Where the `M99 P` of all programs may return to.
  const ReturnTargets &returns() const { return returns_; }

  /// The number of the variable that a name stands for: a system variable of the dialect, one named by SETVN in any of
  /// the files, or, where the control has named parameters, one of the names from kFirstNamedVariable on.  Absent: no
  /// program of the set gives the name a meaning; a control may have been told it before.
  std::optional<std::uint32_t> variableOf(FileId file, Span name) const;
  /// The same for a name of the control, or one that a program writes, in its canonical spelling; absent: there is
  /// none.
  std::optional<std::uint32_t> variableNamed(std::string_view canonical) const;
  /// Some program writes the name, which is in its canonical spelling.
  bool usesName(std::string_view canonical) const;
  /// What the last program that was called has returned; absent where no program asks for it.
  std::optional<std::uint32_t> returnedValue() const;
  /// `#<depth>` for numbers from kFirstNamedVariable on and for names of the control, else `#101`.
  std::string nameOfVariable(std::uint32_t variable) const;
  /// A name that the machine gives a value, or does not, and that may change at any time (`#<_hal[probe.in]>`).
  bool isInputName(std::uint32_t variable) const;
  /// The same of one that stays as it is (`#<_ini[axis_z]home>`).
  bool isSettingName(std::uint32_t variable) const;
  /// A named variable that every program sees (`#<_depth>`).
  bool isGlobalName(std::uint32_t variable) const;
  /// A named variable that each level of calls has for itself (`#<depth>`).
  bool isLocalName(std::uint32_t variable) const;
  /// All of them.
  std::vector<std::uint32_t> localNames() const;

private:
  /// A name where it stands in the text of its file, and what it means.
  struct NamedPlace {
    std::uint32_t begin;
    std::optional<std::uint32_t> variable;
  };

  bool hasNameFrom(std::uint32_t variable, std::string_view beginning) const;
  std::optional<std::uint32_t> meaningOf(const ProgramFile &from, Span name) const;
  void findMeanings(const ProgramFile &file);
  void findNames(const ProgramFile &file);
  void findModalCallees(const ProgramFile &from);
  void findWritten(const ProgramFile &file);
  void findUses(const ProgramFile &file);
  std::optional<Callee> entryOf(std::optional<ProgramRef> program) const;
  std::optional<Callee> localCallee(FileId file, const Call &call) const;

  std::vector<ProgramFile> files_;
  struct FilesOfFolder {
    std::vector<FileId> files;
    bool mayBeIncremental = false;
  };
  std::unordered_map<std::string_view, FilesOfFolder> byFolder_; // in the paths of the sources
  CallGraph callGraph_;
  ReturnTargets returns_;
  std::vector<Callee> modalCallees_; // sorted
  bool hasModalCalls_ = false;
  bool mayCompensate_ = false;
  std::vector<std::uint32_t> written_; // sorted
  std::unordered_map<std::uint32_t, UseCounts> uses_;
  UnnumberedUses unnumbered_;
  const Dialect *naming_ = nullptr; // that of the first file whose control has named parameters
  std::vector<std::string> names_;  // sorted; canonical spelling
  std::vector<std::pair<std::string, std::uint32_t>> namedNumbers_; // by SETVN; sorted
  std::vector<std::vector<NamedPlace>> places_; // by file, in order of the text: runs ask at each step
};

} // namespace feedhold
