// What becomes of a label that several o-words of one program have.
#pragma once

#include "language/model/model.h"

#include <map>

namespace feedhold {

/// At the head of a construct the interpreter of LinuxCNC stops ("duplicate O-word label", interp_o_word.cc) if it has
/// met another head of the same program with this label, in this run: one that it has skipped does not count, and
/// programs that are called keep their labels from call to call.  Rarely: both stand in branches of one `if`, and only
/// another call of the program can meet the other one.
enum class RepeatedLabel : std::uint8_t { Rarely, Perhaps, Surely };
struct LabelRepetition {
  RepeatedLabel kind;
  ConstructId other; // with the same label
};

/// Of the constructs whose label may have been met before.
std::map<ConstructId, LabelRepetition> repeatedLabels(const ProgramModel &model);

} // namespace feedhold
