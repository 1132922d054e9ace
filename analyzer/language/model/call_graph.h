// CallGraph: which program calls which, over all files of a run.
#pragma once

#include "language/model/model.h"

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace feedhold {

/// A program of one file.
struct ProgramRef {
  FileId file;
  ProgramId program;
  friend auto operator<=>(const ProgramRef &, const ProgramRef &) = default;
};

/// One file as the graph sees it.
struct ModelledFile {
  FileId file;
  std::string folder; // a call is looked up in the caller's file, its folder, then in folders near it
  std::string stem;   // file name without extension: `O9010` names a program without O word
  const ProgramModel *model;
};

class CallGraph {
public:
  CallGraph() = default;
  explicit CallGraph(std::vector<ModelledFile> files);

  /// The program that a call reaches; absent when it is in none of the files, or when several have the number.
  std::optional<ProgramRef> callee(FileId file, const Call &call) const;
  /// The programs that a call may reach: several where one number is given twice, so that which of them the control
  /// has in its memory is not known.
  std::vector<ProgramRef> candidates(FileId file, const Call &call) const;
  /// None of the files has the program whose number `M98 P30100` names: it calls O0100, three times.
  bool isPacked(FileId file, const Call &call) const;
  /// Whether a call may reach an encrypted program, of which nothing is known.
  bool reachesEncrypted(FileId file, const Call &call) const;
  /// The file has the name of a subroutine, by which calls from other files find it.
  bool isFileOf(FileId file, std::string_view label) const;
  /// The other programs of its file and its folder that have the name of a program.
  std::vector<ProgramRef> namesakes(ProgramRef program) const;
  /// The calls that reach a program.
  struct Caller {
    FileId file;
    CallId call;
  };
  std::vector<Caller> callers(ProgramRef program) const;
  bool isCalled(ProgramRef program) const { return !callers(program).empty(); }
  /// The longest chain of macro calls (G65, G66 ..) and of all calls that starts in `program`; absent when it is
  /// recursive.
  struct Depth {
    std::size_t macro = 0;
    std::size_t total = 0;
  };
  std::optional<Depth> depthFrom(ProgramRef program) const;
  /// The programs of a call cycle through `program`, itself first; empty when there is none.
  std::vector<ProgramRef> cycleThrough(ProgramRef program) const;
  const ProgramModel &model(FileId file) const;
  std::size_t programCount() const;
  /// The numbers under which programs are found, in order.
  const std::vector<std::uint32_t> &numbers() const;

private:
  struct Impl;
  std::shared_ptr<const Impl> impl_;
};

} // namespace feedhold
