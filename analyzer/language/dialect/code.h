// Code: what a G or M code is for, and what it does.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace feedhold {

/// How a code behaves in a block.  A code has one; the modal group says the rest.
enum class CodeRole : std::uint8_t {
  Plain,
  Motion,      // G00 G01 ..: linear or rapid motion
  Arc,         // G02 G03
  CannedCycle, // words of the block belong to the cycle
  OwnWords,    // a statement whose words are all its own (MANUAL GUIDE i: blanks, figures, cycles); not modelled
  Dwell,
  DataSetting,     // G10: the words of the block (and of those up to G11, for L50/L52) are data
  DataSettingEnd,  // G11
  MachinePosition, // G53
  MacroCall,       // G65
  ModalCall,       // G66
  ModalCallEach,   // G66.1
  ModalCallCancel, // G67
  CoordinateShift, // G52 G92 ..: axis words are values, not motion
  ReferenceReturn, // G28 G30 ..
  Skip,            // G31
  SkipOrAlarm,     // G37, G38.2: a skip move that stops with an alarm where the signal does not come
  Contour,         // cycles that name a contour by sequence numbers P..Q.. (G70-G73 of lathes, G150 ..)
  SubprogramCall,  // M98
  LocalCall,       // M97 of controls that have it
  ExternalCall,    // M198
  Return,          // M99
  ProgramEnd,      // M02 M30
  ProgramStop,     // M00 M01
  JumpOnInput,     // M96 P Q of controls that have it: jumps to N P while input Q is off
};
constexpr bool isSkip(CodeRole role) { return role == CodeRole::Skip || role == CodeRole::SkipOrAlarm; }

/// What a code does to the state of the machine, as far as that is modelled (meaning/semantics).  Every row of a table
/// names one; a test refuses Unclassified.
enum class CodeAction : std::uint8_t {
  Unclassified,
  // Neither variables nor coordinates nor the path change, and why:
  ByRole,       // what it does follows from its role: calls, returns, ends, stops
  Device,       // it moves, switches or asks something beside the path: coolant, doors, chucks, spindles, displays
  Tolerance,    // how fast and how exactly a path is followed, not which one
  Check,        // at most it stops the machine
  EndOfMode,    // it ends a mode of its modal group, which is all that is kept of the mode
  InterruptOff, // no macro interrupt is armed any more
  // Not followed:
  Unmodelled,  // it changes what coordinates mean: nothing is known of positions behind it
  Anything,    // it may change anything
  InterruptOn, // arms a macro interrupt: from here on another program may run, and jump, between any two blocks
  // Followed:
  Rapid,
  Linear,
  ArcClockwise,
  ArcCounterclockwise,
  Thread,
  OtherCurve, // a curve that ends at the programmed point and is not followed on its way
  Dwell,
  CycleOff,
  CycleDrill,
  CycleDwell,
  CyclePeck,
  CycleChipBreak,
  CycleTap,
  CycleTapLeft,
  CycleBore,
  CycleBoreStop,
  CycleBackBore,
  CycleBoreManual,
  CycleBoreDwell,
  CycleFineBore,
  SideCycle,     // drilling cycle of a lathe
  DiameterCycle, // of a lathe, as those below: a cut along Z that returns to where it started
  FaceCycle,     // along X
  ThreadCycle,   // a thread along Z, one pass
  ThreadPasses,
  FaceGroove,     // pecks along Z, side by side along X
  DiameterGroove, // along X, side by side along Z
  FinishContour,
  TurnContour, // cuts along Z up to a contour
  FaceContour, // along X
  RepeatContour,
  CirclePocketClockwise, // about the position, with cutter compensation of its own; it ends at the centre
  CirclePocketCounterclockwise,
  OtherCycle, // words and motion of its own: nothing is known of the position behind it
  PlaneXY,
  PlaneZX,
  PlaneYZ,
  Absolute,
  Incremental,
  ArcAbsolute,    // I, J, K are coordinates
  ArcIncremental, // I, J, K are distances from the start
  Inch,
  Metric,
  FeedInverse,
  FeedPerMinute,
  FeedPerRevolution,
  CompensationOff,
  CompensationLeft,
  CompensationRight,
  LengthPlus,
  LengthMinus,
  LengthGiven, // Z is the length itself
  LengthOff,
  ReturnToInitial,
  ReturnToR,
  ScalingOff,
  ScalingOn,
  MirrorOff,
  MirrorOn,
  RotationOff,
  RotationOn,
  PolarOff,
  PolarOn,
  WorkOffset,
  ExtendedWorkOffset,
  LocalShift,
  CoordinateSet,
  CoordinateSetOff,
  CoordinateSetSuspend, // off, but the offset is kept in its variables
  CoordinateSetRestore,
  MachineMove,
  ReferenceReturn,
  SecondReference,
  ReferenceStore,
  SecondReferenceStore,
  ReferenceCheck,
  Skip,
  ConstantSurface,
  ConstantSpeed,
  SpindleClockwise,
  SpindleCounterclockwise,
  SpindleStop,
  ToolChange,
  CoolantOn,
  CoolantOff,
  ModesSave,          // M70: what is in force is saved, for the present level
  ModesDrop,          // M71: what has been saved is not any more
  ModesRestore,       // M72: what has been saved is in force again
  ModesSaveForReturn, // M73: saved, and in force again when the program returns
};
inline constexpr std::size_t kCodeActions = static_cast<std::size_t>(CodeAction::ModesSaveForReturn) + 1;
/// It returns to where it started.
constexpr bool isTurningCycle(CodeAction action) {
  return CodeAction::DiameterCycle <= action && action <= CodeAction::RepeatContour;
}
/// Its words stay in force from one block to the next.
inline constexpr std::array kSingleTurningCycles = {CodeAction::DiameterCycle, CodeAction::FaceCycle,
                                                    CodeAction::ThreadCycle};
constexpr bool isSingleTurningCycle(CodeAction action) {
  return CodeAction::DiameterCycle <= action && action <= CodeAction::ThreadCycle;
}
constexpr bool isCirclePocket(CodeAction action) {
  return action == CodeAction::CirclePocketClockwise || action == CodeAction::CirclePocketCounterclockwise;
}
/// Cutter compensation begins in its block.
constexpr bool beginsCompensation(CodeAction action) {
  return action == CodeAction::CompensationLeft || action == CodeAction::CompensationRight || isCirclePocket(action);
}
/// No program notices the code in its variables or its path.
constexpr bool changesNothing(CodeAction action) {
  return CodeAction::ByRole <= action && action <= CodeAction::InterruptOff;
}

/// A G or M code.  `tenths`: ten times its number, so that G54.1 is 541.
struct Code {
  std::uint16_t tenths = 0;
  std::uint8_t group = 0; // modal group of the control's own list; 0: not modal
  CodeRole role = CodeRole::Plain;
  CodeAction action = CodeAction::Unclassified;
  std::string_view meaning; // for hover texts and messages: "linear interpolation"
};

} // namespace feedhold
