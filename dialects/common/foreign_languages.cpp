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
    LanguageHint{TextSignal::SinumerikFile, 10},
};
constexpr std::array kOkuma = {
    LanguageHint{TextSignal::OkumaVariable, 12},
    LanguageHint{TextSignal::OkumaControl, 12},
    LanguageHint{TextSignal::OkumaLabel, 4},
    LanguageHint{TextSignal::OkumaFile, 30},
};
/// O-words alone are LinuxCNC's, which is read.
constexpr std::array kPlanet = {
    LanguageHint{TextSignal::OWord, 30},
    LanguageHint{TextSignal::AngleName, 30},
    LanguageHint{TextSignal::PlanetMark, 40},
};
constexpr std::array kSyntec = {
    LanguageHint{TextSignal::SyntecMarker, 40},
    LanguageHint{TextSignal::SyntecControl, 12},
    LanguageHint{TextSignal::ColonAssignment, 8},
};
constexpr std::array kFagor = {
    LanguageHint{TextSignal::FagorStatement, 8},
};
constexpr std::array kDollar = {
    LanguageHint{TextSignal::DollarControl, 12},
    LanguageHint{TextSignal::IsgVariable, 12},
    LanguageHint{TextSignal::IsgCommand, 8},
};
constexpr std::array kFadal = {
    LanguageHint{TextSignal::FadalLine, 12},
};
constexpr std::array kCLike = {
    LanguageHint{TextSignal::CLikeOperator, 6},   LanguageHint{TextSignal::BareCondition, 4},
    LanguageHint{TextSignal::DdcsVariable, 16},   LanguageHint{TextSignal::CentroidStatement, 20},
    LanguageHint{TextSignal::EdingStatement, 12},
};
constexpr std::array kCompiler = {
    LanguageHint{TextSignal::CompilerDirective, 25},
};
constexpr std::array kSender = {
    LanguageHint{TextSignal::SenderStatement, 12},
};

constexpr std::array kLanguages = {
    ForeignLanguage{"Heidenhain Klartext", "Klartext has its own grammar, which is not read; leave these files out",
                    kKlartext},
    ForeignLanguage{"Sinumerik", "only a program in ISO dialect mode (`G291`) can be read, with `--dialect`",
                    kSinumerik},
    ForeignLanguage{"Okuma user task", "OSP programs have named labels and variables, which are not read", kOkuma},
    ForeignLanguage{"RS274NGC of PlanetCNC or grblHAL",
                    "only LinuxCNC's RS274NGC is read; `--dialect linuxcnc` does so where the two agree", kPlanet},
    ForeignLanguage{"Syntec MACRO", "a program without `%@MACRO` is in ISO mode and can be read", kSyntec},
    ForeignLanguage{"Fagor 8055", "statements in parentheses would be taken for comments", kFagor},
    ForeignLanguage{"ISG or Fagor 8060 (`$IF`)", "control statements with `$` are not read", kDollar},
    ForeignLanguage{"Fadal macro", "macro lines that begin with `#` are not read", kFadal},
    ForeignLanguage{"a macro language with C operators (DDCS, Centroid, Eding)",
                    "only Macro B relations such as `EQ` and conditions in brackets are read", kCLike},
    ForeignLanguage{"macro compiler source", "check the part programs, or the text after compilation", kCompiler},
    ForeignLanguage{"sender macro (CNCjs)",
                    "lines that begin with `%` and a name are run by the sender, not by the control", kSender},
};

} // namespace

std::span<const ForeignLanguage> foreignLanguages() { return kLanguages; }

} // namespace feedhold
