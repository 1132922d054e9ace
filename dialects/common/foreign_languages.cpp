// What gives each of them away.  A weight of 30 is a feature that no Macro B program has: once is enough.
#include "dialects/common/foreign_languages.h"

#include <array>

namespace feedhold {
namespace {

constexpr std::array kKlartext = {
    LanguageHint{TextSignal::KlartextFrame, 30},
    LanguageHint{TextSignal::KlartextLabel, 8},
    LanguageHint{TextSignal::KlartextBlock, 4},
    LanguageHint{TextSignal::KlartextParameter, 4},
};
constexpr std::array kSinumerik = {
    LanguageHint{TextSignal::SinumerikDefinition, 12}, LanguageHint{TextSignal::SinumerikControl, 12},
    LanguageHint{TextSignal::SinumerikVariable, 6},    LanguageHint{TextSignal::SinumerikWord, 6},
    LanguageHint{TextSignal::SinumerikFile, 14},
};
constexpr std::array kHeidenhainIso = {
    LanguageHint{TextSignal::HeidenhainIsoBlock, 4},
};
constexpr std::array kErosion = {
    LanguageHint{TextSignal::ErosionRow, 30},
    LanguageHint{TextSignal::ErosionCondition, 8},
    LanguageHint{TextSignal::ErosionSwitch, 12},
    LanguageHint{TextSignal::ErosionValue, 4},
};
/// The name of a file is only a hint: FANUC programs are named so, too.  LAP, "lathe auto-programming", is called by
/// `G85 NLAP1`, and its contour begins with `NLAP1 G81` (OSP programming manual).
constexpr std::array kOkuma = {
    LanguageHint{TextSignal::OkumaVariable, 12},   LanguageHint{TextSignal::OkumaControl, 12},
    LanguageHint{TextSignal::OkumaWorkOffset, 12}, LanguageHint{TextSignal::OkumaLabel, 4},
    LanguageHint{TextSignal::OkumaFile, 30},       LanguageHint{TextSignal::OkumaFileName, 8},
    LanguageHint{TextSignal::OkumaLap, 12},
};
/// O-words alone are LinuxCNC's, which is read.  A mark that LinuxCNC cannot read outweighs all others that are its
/// own, probing and the name of the file (65 together).
constexpr std::array kPlanet = {
    LanguageHint{TextSignal::OWord, 30},
    LanguageHint{TextSignal::AngleName, 30},
    LanguageHint{TextSignal::PlanetMark, 70},
    LanguageHint{TextSignal::MacroBranch, -60},
};
constexpr std::array kGrbl = {
    LanguageHint{TextSignal::OWord, 30},       LanguageHint{TextSignal::AngleName, 30},
    LanguageHint{TextSignal::GrblCommand, 70}, LanguageHint{TextSignal::GrblComment, 40},
    LanguageHint{TextSignal::GrblFile, 70},    LanguageHint{TextSignal::MacroBranch, -60},
    LanguageHint{TextSignal::GrblProbe, 70},
};
constexpr std::array kSyntec = {
    LanguageHint{TextSignal::SyntecMarker, 40},
    LanguageHint{TextSignal::SyntecControl, 12},
    LanguageHint{TextSignal::ColonAssignment, 8},
};
/// Neither `%1234` nor `T1.1` alone is enough: Huazhong's controls have the one, and the other may be a mistake.
constexpr std::array kFagor = {
    LanguageHint{TextSignal::FagorStatement, 8}, LanguageHint{TextSignal::FagorNumber, 10},
    LanguageHint{TextSignal::FagorTool, 2}, LanguageHint{TextSignal::HashVariable, -8}, // its variables are P0 to P299
};
/// Variables and calls are not those of Macro B: a call copies the words A to Z to #0 to #25.
constexpr std::array kHuazhong = {
    LanguageHint{TextSignal::HuazhongFunction, 30}, LanguageHint{TextSignal::HuazhongControl, 30},
    LanguageHint{TextSignal::FagorNumber, 10},      LanguageHint{TextSignal::HuazhongIf, 2},
    LanguageHint{TextSignal::BlockIf, 1},
};
constexpr std::array kLnc = {
    LanguageHint{TextSignal::LncVariable, 6},
};
constexpr std::array kDollar = {
    LanguageHint{TextSignal::DollarControl, 12},
    LanguageHint{TextSignal::IsgVariable, 12},
    LanguageHint{TextSignal::IsgCommand, 8},
};
constexpr std::array kFadal = {
    LanguageHint{TextSignal::FadalLine, 12},
};
constexpr std::array kFadalProgram = {
    LanguageHint{TextSignal::FadalOffset, 6},
    LanguageHint{TextSignal::FadalSubprogram, 2}, // Sinumerik calls subprograms in this way, too
};
/// Of languages that share operators with a wrong RS274NGC program, but do not have o-words.
constexpr int kNoOWords = -12;
constexpr std::array kBeagle = {
    LanguageHint{TextSignal::BeagleLoop, 14},
    LanguageHint{TextSignal::CLikeOperator, 6},
    LanguageHint{TextSignal::OWord, kNoOWords},
};
constexpr std::array kCLike = {
    LanguageHint{TextSignal::CLikeOperator, 6},      LanguageHint{TextSignal::BareCondition, 4},
    LanguageHint{TextSignal::CentroidStatement, 20}, LanguageHint{TextSignal::EdingStatement, 12},
    LanguageHint{TextSignal::LoneEndWhile, 12},      LanguageHint{TextSignal::OWord, kNoOWords},
};
/// Its macros are Macro B with variables of their own; comparisons by characters are common, words are accepted.
constexpr std::array kDdcs = {
    LanguageHint{TextSignal::DdcsMessage, 40},  LanguageHint{TextSignal::DdcsVariable, 16},
    LanguageHint{TextSignal::DdcsOffset, 40},   LanguageHint{TextSignal::DdcsFile, 16},
    LanguageHint{TextSignal::DdcsWord, 8},      LanguageHint{TextSignal::DdcsPosition, 2},
    LanguageHint{TextSignal::DdcsTitle, 2},     LanguageHint{TextSignal::CLikeOperator, 6},
    LanguageHint{TextSignal::BareCondition, 4}, LanguageHint{TextSignal::OWord, kNoOWords},
};
constexpr std::array kCompiler = {
    LanguageHint{TextSignal::CompilerDirective, 25},
};
constexpr std::array kSimulator = {
    LanguageHint{TextSignal::SimulatorSection, 40}, LanguageHint{TextSignal::SimulatorCall, 8},
    LanguageHint{TextSignal::SimulatorCommand, 10}, // one of them is a line that is wrong, in a program to be checked
};
/// Sliding-head lathes of Citizen, and controls of Mitsubishi with several systems.  A program has a part for each, and
/// none of them can be followed without those that it waits for.
constexpr std::array kSystems = {
    LanguageHint{TextSignal::SystemMark, 40},
};
/// NUM 1040 to 1060, Philips (Maho), Traub: the letter that holds the number of passes elsewhere holds a variable.
constexpr std::array kLetterVariables = {
    LanguageHint{TextSignal::LetterVariable, 8},
    LanguageHint{TextSignal::HashVariable, -8},
};
constexpr std::array kOsai = {
    LanguageHint{TextSignal::OsaiStatement, 12},
    LanguageHint{TextSignal::LetterVariable, 8},
    LanguageHint{TextSignal::HashVariable, -8},
};
constexpr std::array kAcramatic = {
    LanguageHint{TextSignal::AlignmentBlock, 12},
};
constexpr std::array kPrinter = {
    LanguageHint{TextSignal::PrinterMessage, 15}, LanguageHint{TextSignal::PrinterObject, 60},
    LanguageHint{TextSignal::PrinterHeater, 8},   LanguageHint{TextSignal::PrinterText, 15},
    LanguageHint{TextSignal::PrinterProbe, 20}, // more than all that G38 speaks for LinuxCNC
    LanguageHint{TextSignal::TemplateName, 8},
};
/// Turbo PMAC takes what follows into a buffer; one such head is enough.
constexpr std::array kPmac = {
    LanguageHint{TextSignal::BufferHead, 40},
};
constexpr std::array kAerotech = {
    LanguageHint{TextSignal::AerotechStatement, 12},
};
/// `METRIC` alone may be a remark that lost its parentheses.
constexpr std::array kDrill = {
    LanguageHint{TextSignal::DrillHead, 10},
};
/// Positions of a job, `C001=..`, look like tables of wire erosion.
constexpr std::array kRobot = {
    LanguageHint{TextSignal::RobotJob, 30},
};
/// Its words have an equals sign, as Sinumerik's have.
constexpr std::array kXilog = {
    LanguageHint{TextSignal::XilogLine, 40},
};
constexpr std::array kTemplate = {
    LanguageHint{TextSignal::EditorTemplate, 30},
};
constexpr std::array kTraining = {
    LanguageHint{TextSignal::TrainingTool, 12},
};
constexpr std::array kLabelP = {
    LanguageHint{TextSignal::LabelP, 70}, // counted where both labels of a contour are written so
};
constexpr std::array kSender = {
    LanguageHint{TextSignal::SenderStatement, 12},
};

constexpr std::array kLanguages = {
    ForeignLanguage{"Heidenhain Klartext", "Klartext has a grammar of its own; exclude these files", kKlartext},
    ForeignLanguage{"Heidenhain DIN/ISO", "its codes differ from those of Macro B controls; exclude these files",
                    kHeidenhainIso},
    ForeignLanguage{"wire erosion (Sodick, Mitsubishi, Accutex)",
                    "erosion machines have codes of their own; exclude these files", kErosion},
    ForeignLanguage{"Sinumerik",
                    "only programs in ISO dialect mode (`G291`) can be read; name the control with `--dialect`",
                    kSinumerik},
    ForeignLanguage{"Okuma user task", "named labels and variables of OSP programs are not supported", kOkuma},
    ForeignLanguage{"RS274NGC of PlanetCNC or grblHAL",
                    "only LinuxCNC's RS274NGC is supported; try `--dialect linuxcnc` where the two agree", kPlanet},
    ForeignLanguage{"RS274NGC of grblHAL or FluidNC", "only LinuxCNC's RS274NGC is supported; exclude these files",
                    kGrbl},
    ForeignLanguage{"Syntec MACRO", "only programs in ISO mode (without `%@MACRO`) can be read", kSyntec},
    ForeignLanguage{"Fagor 8055", "statements in parentheses would be read as comments", kFagor},
    ForeignLanguage{"a macro for Huazhong HNC",
                    "its variables and calls are not those of a Macro B control; exclude these files", kHuazhong},
    ForeignLanguage{"LNC macro", "variables such as `@100` are not supported", kLnc},
    ForeignLanguage{"ISG or Fagor 8060 (`$IF`)", "control statements with `$` are not supported", kDollar},
    ForeignLanguage{"Fadal macro", "macro lines that begin with `#` are not supported", kFadal},
    ForeignLanguage{"a program for Fadal",
                    "`E` is the fixture offset there, and `L` alone begins or calls a subprogram; exclude these files",
                    kFadalProgram},
    ForeignLanguage{"a macro language with C operators (Centroid, Eding)",
                    "only Macro B comparisons such as `EQ` and conditions in brackets are supported", kCLike},
    ForeignLanguage{"a macro for BeagleG", "its loops and operators are not those of Macro B; exclude these files",
                    kBeagle},
    ForeignLanguage{"a macro for DDCS",
                    "its variables mean something else than on a Macro B control; exclude these files", kDdcs,
                    Resemblance::MacroB},
    ForeignLanguage{"macro compiler source", "check the part programs, or the compiled text", kCompiler},
    ForeignLanguage{"a program for a machine simulator", "parts of it are for the simulator; exclude these files",
                    kSimulator},
    ForeignLanguage{"a program for a machine with several systems (Citizen, Mitsubishi)",
                    "the parts for `$1`, `$2`, .. run at the same time; exclude these files", kSystems},
    ForeignLanguage{"a program for NUM, Philips or Traub", "variables such as `L1` and `E1` are not supported",
                    kLetterVariables},
    ForeignLanguage{"a program for OSAI", "statements in parentheses would be read as comments", kOsai},
    ForeignLanguage{"a program for Acramatic (Cincinnati)", "its codes are not those of a Macro B control", kAcramatic},
    ForeignLanguage{"G code of a printer or a hobby control (Marlin, Smoothieware, RepRap)",
                    "its M codes and messages are not those of a Macro B control; exclude these files", kPrinter},
    ForeignLanguage{"a program for a PMAC motion controller (Delta Tau)",
                    "its programs and PLCs are not those of a Macro B control; exclude these files", kPmac},
    ForeignLanguage{"AeroBasic of an Aerotech controller",
                    "its variables and statements are not those of a Macro B control; exclude these files", kAerotech},
    ForeignLanguage{"an Excellon drill file",
                    "drill files of circuit boards have codes of their own; exclude these files", kDrill},
    ForeignLanguage{"a robot job (Yaskawa INFORM)", "jobs of robots are no NC programs; exclude these files", kRobot},
    ForeignLanguage{"Xilog (SCM)", "words such as `X=10` are not supported; exclude these files", kXilog},
    ForeignLanguage{"a template for an editor", "check the program that is made from it; exclude these files",
                    kTemplate},
    ForeignLanguage{"a program for a training control (PAL)",
                    "its tools and cycles are not those of a FANUC control; exclude these files", kTraining},
    ForeignLanguage{"a program for a simulator whose labels are P words",
                    "`G71 P1 Q2` looks for N1 and N2 on a FANUC control; exclude these files", kLabelP},
    ForeignLanguage{"sender macro (CNCjs)",
                    "lines that begin with `%` and a name are executed by the sender, not by the control", kSender},
};

} // namespace

std::span<const ForeignLanguage> foreignLanguages() { return kLanguages; }

} // namespace feedhold
