// The guess on small texts of every kind.
#include "dialects/registry.h"
#include "language/dialect/folder_vote.h"
#include "language/dialect/text_signals.h"

#include <algorithm>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <string>

namespace feedhold {
namespace {

/// The id of the dialect, the name of the language that is refused, or "none".
std::string guessed(std::string_view text, std::string_view path = "part.nc") {
  const LanguageGuess guess = guessLanguage(text, path, allDialects());
  if (!guess.looksLikeProgram)
    return "none";
  return std::string(guess.foreign != nullptr ? guess.foreign->name : guess.dialect->id);
}

TEST(Guess, NothingSpecialIsTheFirstDialect) {
  EXPECT_EQ(guessed("%\nO1000\nG00 G90 G54 X0 Y0\nM30\n%\n"), "fanuc-30i");
  EXPECT_EQ(guessed("M30"), "fanuc-30i");
  EXPECT_EQ(guessed("IF[#1EQ0]GOTO9020\nG65P0142A#4B#5\nN9020M99\n"), "fanuc-30i");
  EXPECT_EQ(guessed("g1x#611f#9\rg0 z 1 0.\r"), "fanuc-30i");
}

TEST(Guess, SeriesNamedInAComment) {
  EXPECT_EQ(guessed("O100(FANUC 0I-MD)\nG0X1.\nM30\n"), "fanuc-0i");
  EXPECT_EQ(guessed("O100(FANUC 31I-B)\nG0X1.\nM30\n"), "fanuc-30i");
}

TEST(Guess, Haas) {
  EXPECT_EQ(guessed("%\nO00012 (PART)\nG00 G90 X0.\nM97 P100\nM30\nN100 G01 Z-1.\nM99\n%\n"), "haas-ngc");
  EXPECT_EQ(guessed("#10000 = #3020\nG103 P1\nIF [#10000 GT 5] GOTO 10\nN10 M30\n"), "haas-ngc");
}

TEST(Guess, RemarksBehindColons) {
  EXPECT_EQ(guessed("%\n:(HYPOTENUSE)\n:(A = ONE SIDE)\n:(C = THE OTHER)\n:(V = RESULT)\nO9001\n"
                    "#[#22] = SQRT[[#3 * #3] - [#1 * #1]]\nM99\n%\n"),
            "fanuc-30i");
}

TEST(Guess, MitsubishiAndRelatives) {
  EXPECT_EQ(guessed("IF[#4012EQ54]GOTO2\n#900010=#410+1\nN2M99\n"), "mitsubishi-m700");
  EXPECT_EQ(guessed("IF [#11 EQ #0] THEN (NO ARGUMENT)\n#3006=1(NO H)\nENDIF\nM99\n", "CHECK.EIA"), "mitsubishi-m700");
}

TEST(Guess, NamesBesideMacroBranches) {
  EXPECT_EQ(guessed("O12\nN5 #<SIZE>=#110\nN6 IF [#<SIZE> GT 4] GOTO 9\nN7 #111=2\nN9 M30\n"), "fanuc-30i");
  EXPECT_EQ(guessed("#<size>=4\no10 if [#<size> gt 2]\nG0 X1\no10 endif\nM2\n"), "linuxcnc");
}

TEST(Guess, ThenWithAStatementIsNoBlockIf) {
  EXPECT_EQ(guessed("WHILE [#1 GT 2] DO1\nIF [#1 LT 4] THEN #1=#5\n#1=#1-1\nEND1\nM99\n"), "fanuc-30i");
}

TEST(Guess, Lathes) {
  EXPECT_EQ(guessed("O10\nG50 S2000\nT0101\nG96 S180 M03\nG71 U2. R1.\nG71 P10 Q20 U0.4 W0.1 F0.3\nM30\n"),
            "fanuc-30i-lathe");
  EXPECT_EQ(guessed("O00010\nT101\nG50 S2000\nG96 S180\nG71 P1 Q2 U.02 W.005 D.05 F.012\nM97 P5\nM30\n"),
            "haas-ngc-lathe");
}

TEST(Guess, CodesOfOneBlockSayLathe) {
  EXPECT_EQ(
      guessed("O1\nT0303\nM03\nS1200\nG96\nG50 S4000\nG00 Z.1 X1.\nG71 P10\nQ20\nN10 G00 X0\nN20 G01 Z-1.\nM30\n"),
      "fanuc-30i-lathe");
  EXPECT_EQ(
      guessed("O2\nG21 G40 G90\nT0303\nG97 S1000 M03\nG00 X50. Z2.\nG74 R1.\nG74 X20. Z-20. P1500 Q5000 F.1\nM30\n"),
      "fanuc-30i-lathe");
}

TEST(Guess, SwitchingAnOutputSaysHaas) {
  EXPECT_EQ(guessed("O1\nT02 M06\nM59 P2\nG04 P1.\nM59 P3\nG01 G90 F650. Z0.\nM30\n"), "haas-ngc");
}

TEST(Guess, LathesWithoutCycles) {
  EXPECT_EQ(guessed("O1\nG28U0W0\nT0101\nG97S1000M3\nG0X20.Z5.\nG1Z-10.F0.2\nG28U0W0\nM30\n"), "fanuc-30i-lathe");
  EXPECT_EQ(guessed("O1\nG0 X20. Z5.\nG1 X22. Z-1.\nG1 X30. Z-20.\nM30\n"), "fanuc-30i-lathe");
  EXPECT_EQ(guessed("O1\nG0 X20. Z5.\nM99\n", "/shop/LATHE 2/O1"), "fanuc-30i-lathe");
  EXPECT_EQ(guessed("O1\nG28 X0 Z0\nG0 X20. Z5.\nM99\n"), "fanuc-30i");
  EXPECT_EQ(guessed("O1\nT0101 M06\nG43 H1 Z50.\nG0 X1. Y2.\nM30\n"), "fanuc-30i");
}

TEST(Guess, ThreadsWithoutYAreOfALathe) {
  EXPECT_EQ(guessed("#1=0\nWHILE[#1LT3]DO1\nG0X#1\nG32Z-20.F1.5Q#1\nG0X30.\nG0Z2.\n#1=#1+1\nEND1\n"),
            "fanuc-30i-lathe");
  EXPECT_EQ(guessed("#1=0\nG0X10.Y#1\nG32Z-20.F1.5\nG0Z2.\nG0Y0\nM30\n"), "fanuc-30i");
}

TEST(Guess, DistanceModesAreNoLathes) {
  EXPECT_EQ(guessed("O1\nG90 G0 X20. Z5.\nG1 X22. Z-1.\nG1 X30. Z-20.\nM30\n"), "fanuc-30i");
  EXPECT_EQ(guessed("O1\nG50 S2000\nT0101\nG90 X20. Z-5. F0.2\nX18.\nM30\n"), "fanuc-30i-lathe");
}

TEST(Guess, ALimitOfTheSpindleSaysLatheInSpiteOfAYAxis) {
  EXPECT_EQ(
      guessed(
          "O1\nG50S1800\nG97S2000M3\nG0X12.0Z2.0\nG0W-2.0\nT3200\nG0X3.0Y17.0Z5.5C0.0\nM6\nG1X2.9F0.2\nG1Y-8.5F0.03\n"
          "G0Y8.5\nM7\nG0W-0.2\nM99\n"),
      "fanuc-30i-lathe");
  EXPECT_EQ(guessed("O1\nG50S1800\nG18\nM6T025300\nG17G98\nG00Z140.\nX160.Y0\nG12.1\nG01X80.F100.\nG13.1\nM30\n"),
            "fanuc-30i-lathe");
  EXPECT_EQ(guessed("O1\nT1M6\nG90G54G0X0Y0\nG92S3000\nG43H1Z50.\nG1Y10.F100.\nM30\n"), "fanuc-30i");
}

TEST(Guess, WhatItRestsOn) {
  const auto basisOf = [](std::string_view text) { return guessLanguage(text, "", allDialects()).basis; };
  EXPECT_EQ(basisOf("G0 X1. Y2.\nM30\n"), GuessBasis::Nothing);
  EXPECT_EQ(basisOf("G50 S2000\nG0 X1. Z2.\nM30\n"), GuessBasis::Text);
  EXPECT_EQ(basisOf("M97 P1\nM30\n"), GuessBasis::Text);
}

TEST(Guess, MarksInCodeOutweighComments) {
  EXPECT_EQ(guessed("O00012(3\" MITSUBISHI FACE MILL)\nIF [#1 EQ 2] THEN\n#2=1\nENDIF\nM97 P1\nM30\n"), "haas-ngc");
  EXPECT_EQ(guessed("O1(HAAS VISE JAWS)\nG0 X1. Y1.\nM30\n"), "fanuc-30i");
  EXPECT_EQ(guessed("O1(FOR THE FANUC)\n#100000=1\n#100002=2\n#1=#100010\n#2=#16005\nM99\n"), "mitsubishi-m700");
  EXPECT_EQ(guessed("O1(LIKE FANUC)\n#1=#3021\n#2=#3021\nM99\n"), "haas-ngc");
}

TEST(Guess, MacroAIsOfOlderSeries) {
  EXPECT_EQ(guessed("O9010\nG65 H01 P#101 Q#102\nG65 H81 P100 Q#101 R1\nN100 M99\n"), "fanuc-0i");
  EXPECT_EQ(guessed("O1\nG65 P9010 H5. A1.\nM30\n"), "fanuc-30i");
}

TEST(Guess, OWords) {
  EXPECT_EQ(guessed("o100 sub\n#<depth> = 3\no110 if [#1 gt 2]\ng1 z-1 f100\no110 endif\no100 endsub\nm2\n"),
            "linuxcnc");
  EXPECT_EQ(guessed("N10 O<part one> CALL [#1] [2]\nM2\n"), "linuxcnc");
  EXPECT_EQ(guessed("g0 x#<_ini[AXIS_X]HOME> ; home\nm2\n"), "linuxcnc");
  EXPECT_EQ(guessed("g0 x1 ; a remark\nm2\n", "part.ngc"), "linuxcnc");
  EXPECT_EQ(guessed("O9000\nG65 P9001 A1.\nM99\n", "O9000.ngc"), "fanuc-30i");
}

TEST(Guess, LanguagesThatAreRefused) {
  EXPECT_EQ(guessed("0 BEGIN PGM T1 MM\n1 TOOL CALL 1 Z S800\n2 L X+10 Y+0 R0 FMAX M3\n3 END PGM T1 MM\n", "T1.H"),
            "Heidenhain Klartext");
  EXPECT_EQ(guessed("PROC WARM(REAL SPEED)\nDEF INT N1\nR1=5\nIF R1>4 GOTOF ENDE\nG0 X=R1\nENDE: M17\n", "x.txt"),
            "Sinumerik");
  EXPECT_EQ(guessed("NTOP G0 X=VC1\nVC1=VC1+1\nCALL OPULL PL=2\nRTS\n"), "Okuma user task");
  EXPECT_EQ(guessed("(dlgname,Measure)\n(dlgshow)\no<chk> if[#<option> EQ 1]\nG65 P191 D#<dist>\no<chk> endif\nM2\n"),
            "RS274NGC of PlanetCNC or grblHAL");
  EXPECT_EQ(guessed("o10 if [#<_selected_tool> LT 0]\n(print, tool)\n$Alarm/Send=3\no10 endif\n$H\nM6\n"),
            "RS274NGC of grblHAL or FluidNC");
  EXPECT_EQ(guessed("%@MACRO\n@1 := 5;\n#1 := @1 + 2;\nIF #1 > 3 THEN\nEND_IF;\nM99;\n"), "Syntec MACRO");
  EXPECT_EQ(guessed("(P1=5)\n(CALL 3)\nG1 X10\n(RET)\n"), "Fagor 8055");
  EXPECT_EQ(guessed("$IF V.P.COUNT > 3\nG1 X10\n$ENDIF\nM30\n"), "ISG or Fagor 8060 (`$IF`)");
  EXPECT_EQ(guessed("#V10 = 5\n#IF V10 > 3 THEN GOTO :NEXT\n#PRINT \"A\"\n#:NEXT\nM30\n"), "Fadal macro");
  EXPECT_EQ(guessed("#50=1\nIF #50 == 2 && #51 > 3 GOTO1\nIF #3 != 0 GOTO2\nN1\nN2 M30\n"),
            "a macro language with C operators (Centroid, Eding)");
  EXPECT_EQ(guessed("$INCLUDE COMMON\n@SPEED 100\n@FEED 101\nO9000\n#1=5\nM99\n"), "macro compiler source");
  EXPECT_EQ(guessed("%wait\n%X0=posx, Y0=posy\nG21\nM5\n"), "sender macro (CNCjs)");
}

TEST(Guess, StatementsOfFagorStandAlone) {
  EXPECT_EQ(guessed("O1\n#100=1. (p1=1)\n#101=2. (p2=2)\n#102=3. (p3=[1,2])\nM30\n"), "fanuc-30i");
  EXPECT_EQ(guessed("O1\n(p1=1)\n#100=1.\n(p2=2)\n#101=2.\n(p3=3)\n#102=#101\nM30\n"), "fanuc-30i");
  EXPECT_EQ(guessed("N10 (P1=5)\n(P2=P1+1)\nG1 X10\n(RET)\n"), "Fagor 8055");
}

TEST(Guess, OneRowOfConditionsIsWireErosion) {
  constexpr std::string_view kErosion = "wire erosion (Sodick, Mitsubishi, Accutex)";
  EXPECT_EQ(guessed("//OFFSET\nE001=11 14 12 08 07 09 40 12;CUT1\nH1=0.15\nM26Q0.01\nG90 G21\n#1=8.\n#2=#1*2\n"
                    "IF [#2 GT #1] GOTO 1\nN1 G1 G41 H1 X#1 Y#2 A0\nX-#1\nY-#2\nM02\n"),
            kErosion);
  EXPECT_EQ(guessed("G21 G90\nM68 E1 Q5\nG0 X1\nE1=5\nM30\n"), "fanuc-30i");
}

TEST(Guess, OneCommandOfFluidNcRefusesAProgramWithNames) {
  EXPECT_EQ(guessed("G38.3 Z[#<_a>] F300\nG38.2 Z[#<_b>] F20\nG38.5 Z0 F20\nG38.2 Z[#<_c>] F10\nG38.2 Z[#<_c>] F5\n"
                    "o9 if [#<_c> GT 1]\n  $Alarm/Send=2\no9 endif\nM2\n",
                    "check.ngc"),
            "RS274NGC of grblHAL or FluidNC");
  EXPECT_EQ(guessed("G38.3 Z[#<_a>] F300\no9 if [#<_a> GT 1]\n(abort, bad)\no9 endif\nM2\n", "check.ngc"), "linuxcnc");
}

TEST(Guess, SettingsByTheirNumbersAreGrbl) {
  EXPECT_EQ(guessed("$110=1000\n$111=100\nG38.2 Z-10 F$110\nG0 Z5\nM0\n"), "RS274NGC of grblHAL or FluidNC");
  EXPECT_EQ(guessed("O1\n$1\nG0 X1\n$2\nG0 X2\nM30\n"),
            "a program for a machine with several systems (Citizen, Mitsubishi)");
  EXPECT_EQ(guessed("M3 $0 S1000\nM3 $1 S500\no1 if [1]\no1 endif\nM2\n"), "linuxcnc");
}

TEST(Guess, GrblByItsNameOrItsFiles) {
  constexpr std::string_view kGrbl = "RS274NGC of grblHAL or FluidNC";
  EXPECT_EQ(guessed("( Created by GrblGru )\nG21 G90\nG0 Z25\nG1 Z-1 F100\nM2\n"), kGrbl);
  EXPECT_EQ(guessed("o1 if [#<_current_tool> EQ 1]\nM61 Q#<_selected_tool>\no1 endif\nM99\n", "tc.macro"), kGrbl);
  EXPECT_EQ(guessed("O9010\nIF[#1EQ#0]GOTO10\n#3000=1\nN10 G65 P9011 A1.\nM99\n", "probe.macro"), "fanuc-30i");
}

TEST(Guess, HobbyControls) {
  constexpr std::string_view kHobby = "G code of a printer or a hobby control (Marlin, Smoothieware, RepRap)";
  EXPECT_EQ(guessed("G91\nG38.2 Z P0\nG10 L20 P1 Z25.4\nG0 Z2.5\n"), kHobby);
  EXPECT_EQ(guessed("G28\nM98 P\"/macros/tool.g\"\nM291 P\"Measure\" S2\nG1 X10\n"), kHobby);
  EXPECT_EQ(guessed("M190 S[bed_temperature]\nM109 S[first_layer_temperature]\nG1 F{speed}\nG1 X5\n"), kHobby);
  EXPECT_NE(guessed("O1\nSETVN 101[VAC_HOLD]\nSETVN 102[PART_NO]\nSETVN 103[A_B]\n#101=1\nM30\n"), kHobby);
  EXPECT_EQ(guessed("G38.2 Z-10 F100\n#<_a>=#5063\no1 if [#<_a> LT 0]\no1 endif\nM2\n"), "linuxcnc");
}

TEST(Guess, ThicknessOfThePlateBesideAProbingMoveIsFluidNc) {
  EXPECT_EQ(guessed("o1 if [#<_a> GT 1]\nG53 G0 Z-20\nG38.2 G91 Z[-#<_b>] F100 P0\nG0 Z3\no1 endif\n"),
            "RS274NGC of grblHAL or FluidNC");
}

TEST(Guess, OneSettingByItsPathIsFluidNc) {
  EXPECT_EQ(guessed("#<_a>=5\nG53 G0 Z#</probe/rapid_z>\nG53 G38.2 Z-40 F500\nD#<_a>\nM2\n", "set.nc"),
            "RS274NGC of grblHAL or FluidNC");
}

TEST(Guess, Huazhong) {
  constexpr std::string_view kHuazhong = "a macro for Huazhong HNC";
  EXPECT_EQ(guessed("%0001\nG92 X0 Z50\n#10=0\nWHILE #10 LE 8\nG1 X[#10] F500\n#10=#10+0.1\nENDW\nM30\n"), kHuazhong);
  EXPECT_EQ(guessed("O9810\nIF [AR[#23] EQ 90]\n#1=#23\nENDIF\nM99\n"), kHuazhong);
  EXPECT_EQ(guessed("%9811\nIF[#19 LE 6]\n#3=1\nENDIF\nIF[#19 GT 9]\n#3=2\nENDIF\nM99\n"), kHuazhong);
}

TEST(Guess, ConditionsWithoutActionAloneAreNotHuazhong) {
  EXPECT_EQ(guessed("O1\nIF [#1 EQ 1]\nG0 X1.\nIF [#1 EQ 2]\nG0 X2.\nM30\n"), "fanuc-30i");
  EXPECT_EQ(guessed("%1234\nIF [#1 EQ 1] GOTO10\nG0 X1.\nN10M30\n"), "fanuc-30i");
}

TEST(Guess, BlocksOfIfAreWeakerThanANamedControl) {
  constexpr std::string_view kBlocks = "IF [#1 EQ 1] THEN\n#2=1\nENDIF\nIF [#1 EQ 2] THEN\n#2=2\nENDIF\nM99\n";
  EXPECT_EQ(guessed(std::string("O9010 (HAAS NGC)\n").append(kBlocks)), "haas-ngc");
  EXPECT_EQ(guessed(std::string("O9010\n").append(kBlocks)), "mitsubishi-m700");
}

TEST(Guess, DdcsByAnyOfItsOwnMarks) {
  constexpr std::string_view kDdcs = "a macro for DDCS";
  EXPECT_EQ(guessed("#1505 = -5000(wait)\nIF #1 == 2 GOTO1\nIF #3 != 0 GOTO2\nN1\nN2 M30\n"), kDdcs);
  EXPECT_EQ(guessed("O501\nIF[#1EQ1]GOTO1\n#1503=1(no sensor)\nN1M99\n"), kDdcs);
  EXPECT_EQ(guessed("#2070=60(plate thickness)\n#61=#60*2\nG91G0Z#61\nM30\n"), kDdcs);
  EXPECT_EQ(guessed("#10=#880\n#[805+[#578-1]*5]=#10\nM30\n"), kDdcs);
  EXPECT_EQ(guessed("G91 G31 Z-50 F100 P3 L0 K0 Q1\nIF #1922<2 GOTO9\n#60=#882\nN9 M30\n"), kDdcs);
  EXPECT_EQ(guessed("WHILE #60<5 DO1\n#60=#60+1\nG4 P-1\nEND1\nM30\n"), kDdcs);
  EXPECT_EQ(guessed("O10000010\nM3\nG4P-1\nM99\n", "slib-m.nc"), kDdcs);
}

TEST(Guess, DdcsIsNotSeenInMacrosOfOthers) {
  EXPECT_EQ(guessed("O1\n#2070=0.1\n#2071=0.2\n#880=#5021\n#790=#881+#882\nG31 Z-10. F50\nM99\n"), "fanuc-30i");
  EXPECT_EQ(guessed("O1\n#2070=#2070+#24 (WEAR)\nG4 P1000\nIF[#500GT3]GOTO10\nN10 M99\n"), "fanuc-30i");
  EXPECT_EQ(guessed("O10000601\n#1=1\nIF[#1GT3]GOTO10\nN10 M30\n"), "fanuc-30i");
  EXPECT_EQ(guessed("#1500=1\no100 if [#1500 gt 1]\no200 call [#1500]\no100 endif\nm2\n"), "linuxcnc");
}

TEST(Guess, DdcsTakesItsFolderAlong) {
  const auto guessOf = [](std::string_view text) { return guessLanguage(text, "", allDialects()); };
  const LanguageGuess ddcs = guessOf("#1505=1(probe now)\nG31Z-50F100P3L0K0Q1\nM30\n");
  const LanguageGuess neutral = guessOf("O600\n#50=#50+1\nIF #50 > 3 GOTO1\nG0X#50\nN1M99\n");
  const LanguageGuess plain = guessOf("G0 X1 Y2\nM30\n");
  const LanguageGuess haas = guessOf("O00012\nM97 P1\nG103 P1\nM97 P2\nG0 X1. Y2.\nG154 P3\nG43 H1 Z1.\nM30\n");
  FolderVote vote(allDialects());
  vote.add(ddcs);
  for (int i = 0; i < 3; ++i)
    vote.add(neutral);
  vote.add(plain);
  ASSERT_EQ(ddcs.foreign->name, "a macro for DDCS");
  EXPECT_TRUE(vote.isClear());
  EXPECT_EQ(vote.decide(neutral).foreign, ddcs.foreign);
  EXPECT_EQ(vote.decide(plain).foreign, ddcs.foreign);
  EXPECT_EQ(vote.decide(haas).foreign, nullptr);

  vote.add(haas);
  EXPECT_EQ(vote.decide(plain).foreign, nullptr) << "programs of another control lie in the folder";
}

TEST(Guess, PlainTextsOfOtherLanguagesAreRefused) {
  EXPECT_EQ(guessed("G54\nG0 X10 Y5\nM30\n", "WELLE.MPF"), "Sinumerik");
  EXPECT_EQ(guessed("N10 T=\"MILL_10\" M6\nN20 CYCLE800(1,\"TC1\",0)\nN30 TRAORI\nN40 G0 X10\nM30\n"), "Sinumerik");
  EXPECT_EQ(guessed("G15 H1\nG0 X10 Y5\nG56 H2 Z100\nM02\n"), "Okuma user task");
  EXPECT_EQ(guessed("%NAME G71 *\nN10 G30 G17 X+0 Y+0 Z-40*\nN20 G99 T1 L+0 R+5*\nN30 G00 G40 G90 Z+250*\nN40 M2*\n"),
            "Heidenhain DIN/ISO");
  EXPECT_EQ(guessed("%PART,MX--,\nN10 G90 G54\nN20 (P1=5)\nN30 (RPT N1,N9)\nM30\n"), "Fagor 8055");
  EXPECT_EQ(guessed("C000 = 0003 0015 2015\nC001 = 0010 0015 2010\nH000 = +000000.0100\nG90 G92 X0 Y0\nM02\n"),
            "wire erosion (Sodick, Mitsubishi, Accutex)");
  EXPECT_EQ(
      guessed("E001=10 12 14 10 05 15 45;CUT1\nE002=09 20 04 07 03\nH1=0.2\nG90 G92 X0 Y0\nG1 G42 H1 X5. A0\nM02\n"),
      "wire erosion (Sodick, Mitsubishi, Accutex)");
  EXPECT_EQ(guessed("H20=2.5\nG92 X0 Y0\nG1 XH20 YH21\nG1 XH22 Y0\nM02\n"),
            "wire erosion (Sodick, Mitsubishi, Accutex)");
  EXPECT_EQ(guessed("T84T86\nS101D1\nC001\nG92X0Y0\nG41D1G01X5.\nM02\n"), "wire erosion (Sodick, Mitsubishi, Accutex)");
  EXPECT_EQ(guessed("N10 D00 Q1 P01 +5 *\nN20 G00 X+10 Y+0 *\nN30 D01 Q2 P01 Q1 P02 +3 *\n"), "Heidenhain DIN/ISO");
  EXPECT_EQ(guessed("N10 (P100=5)\nN15 (IF P100 EQ 5 GOTO N20)\nN20 G0 X1\nM30\n"), "Fagor 8055");
  EXPECT_EQ(guessed("G21\n$TCS=READ id=0 p=tcs\no100 sub\nG0 X1\no100 endsub\nM2\n"), "RS274NGC of grblHAL or FluidNC");
  EXPECT_EQ(guessed("; bore\n@100 = 25 ; size\nG43 H1 Z@820\nM10814 D@880\nM30\n"), "LNC macro");
  EXPECT_EQ(guessed("N1 O7 (PLATE)\nN2 M6 T1\nN3 G0 G90 X0 Y0 E1 S900 M3\nN4 H1 Z20. M8\nN5 G1 Z-1. F90.\n"
                    "N6 G90 H0 Z0.\nN7 E0 X0. Y200.\nN8 M2\n"),
            "a program for Fadal");
  EXPECT_EQ(guessed("N1 L300\nN2 X5. Y5.\nN3 M17\nN4 M30\nN5 G0 G90 E2 X0 Y0\nN6 G81 Z-2. R1. F50. L0\nN7 L301\n"
                    "N8 L301\nN9 M2\n"),
            "a program for Fadal");
  EXPECT_EQ(guessed("#2=12\n#3=[360/#2]\n#4=0\nWHILE [#4 < #2] DO\nG1 X[10*#4]\n#4=[#4+1]\nEND\n"),
            "a macro for BeagleG");
  EXPECT_EQ(guessed("%00210\nN0 T1.1\nN10 M6\nN20 G0 G43 Z10\nN30 M30\n"), "Fagor 8055");
}

TEST(Guess, OneMarkOfAnotherLanguageIsNotEnough) {
  EXPECT_EQ(guessed("%1234\nT0101\nG90 G54 G0 X0 Y0\nM30\n%1235\nG0 X1\nM99\n"), "fanuc-30i");
  EXPECT_EQ(guessed("O1\nT1.1 M6\nT2.1 M6\nT3.1 M6\nG43 H1 Z5.\nM30\n"), "fanuc-30i");
  EXPECT_EQ(guessed("O1\nG43 H1 XH2\nG0 Z@5\nE1=5\nM30\n"), "fanuc-30i");
  EXPECT_EQ(guessed("G21 G90\nM68 E3 Q0\nM66 P0 E1\nM68 E0 Q1\nG64 P0.01\nG0 X0 Y0\nM2\n"), "linuxcnc");
  EXPECT_EQ(guessed("O1\nT0101\nG50 S2000\nG97 S500 M3\nG0 X20. Z5.\nG32 Z-20. E2\nG0 X30.\nG32 Z-20. E2\nM30\n"),
            "fanuc-30i-lathe");
  EXPECT_EQ(guessed("O1\n#1=1\nWHILE [#1 LT 5] DO\n#1=#1+1\nEND\nM30\n"), "fanuc-30i");
}

TEST(Guess, ToolsOfThreeDigitsAreOfALathe) {
  EXPECT_EQ(guessed("O2\nG99G97S800M3\nT303\nG0X50.Z5.\nG83Z-40.Q3000F.1\nG80\nM30\n"), "fanuc-30i-lathe");
  EXPECT_EQ(guessed("O2\nT312M6\nG90G54G0X50.Z5.\nM30\n"), "fanuc-30i");
}

TEST(Guess, CyclesInOneBlockWithADecimalDepthAreOfHaas) {
  EXPECT_EQ(guessed("O1\nT101\nG50 S2000\nG96 S200 M03\nG00 X2. Z.1\nG71 P10 Q20 U.02 W.005 D.05 F.01\n"
                    "N10 G00 X1.\nG01 Z-1.\nN20 X2.\nM30\n"),
            "haas-ngc-lathe");
  EXPECT_EQ(guessed("O1\nT101\nG50 S2000\nG96 S200 M03\nG00 X2. Z.1\nG71 U.05 R.02\nG71 P10 Q20 U.02 W.005 F.01\n"
                    "N10 G00 X1.\nG01 Z-1.\nN20 X2.\nM30\n"),
            "fanuc-30i-lathe");
  EXPECT_EQ(guessed("O1\nT1 M6\nG43 H1 Z1.\nG13 I.25 K1. Q.25 D1 F20.\nM30\n"), "haas-ngc");
  EXPECT_EQ(guessed("O1\nT1 M6\nG43 H1 Z1.\nG13 I.25 K1. D01 Q.25\nG13 I.25 K2. D01 Q.25\nG13 I.25 K3. D01 Q.25\n"
                    "M30\n"),
            "haas-ngc");
}

TEST(Guess, LinuxCncWithoutOWords) {
  EXPECT_EQ(guessed("G21 G90\nG64 P0.01\nG0 X0 Y0\nM2\n"), "linuxcnc");
  EXPECT_EQ(guessed("(PathPilot Version: 2.9)\nG7\nG18 G90\nG30\nT0303\nG96 S 150 D 1800\nG95 F 0.1\nM3\n"
                    "G0 X 1.2 Z -0.9\nG1 X 0.4 Z -1.1\nM30\n"),
            "linuxcnc");
  EXPECT_EQ(guessed("(Post: LinuxCNC)\nG21 G90\nT1 M6\nG43 H1\nG0 X0 Y0\nM2\n"), "linuxcnc");
  EXPECT_EQ(guessed("O0060(TEXT)\nT1 M06\nG54 G90 G00 X1. Y1.\nG47 P0 (NAME) X2. Y2. I45. J.2 R.1 Z-.01 F10.\nM30\n"),
            "haas-ngc");
  EXPECT_EQ(guessed("G0 X0 Y0\nG38.2 Z-10 F50\nM2\n"), "linuxcnc");
  EXPECT_EQ(guessed("O1\nG05.1 Q1\nG54.1 P3\nG64\nG0 X0 Y0\nM30\n"), "fanuc-30i");
}

TEST(Guess, DirectivesOfSimulatorsSayNothing) {
  EXPECT_EQ(guessed("O1\n[BILLET X40 Y40 Z20\n[TOOLDEF T1 D6\nG54 G0 X0 Y0\nM30\n"), "fanuc-30i");
}

TEST(Guess, FolderDecidesWhereATextFitsSeveralControls) {
  const auto guessOf = [](std::string_view text) { return guessLanguage(text, "", allDialects()); };
  const LanguageGuess neutral = guessOf("O1\n#1=#1+1\nM99\n");
  const LanguageGuess lathe = guessOf("O2\nG50 S2000\nT0101\nG96 S180\nM30\n");
  const LanguageGuess clear = guessOf("O00012\nM97 P1\nG103 P1\nM97 P2\nG0 X1. Y2.\nG1 Y3.\nY4.\nG43 H1 Z1.\nM30\n");
  FolderVote vote(allDialects());
  for (const LanguageGuess &guess : {neutral, lathe, clear})
    vote.add(guess);
  vote.add(lathe);
  EXPECT_EQ(neutral.dialect->id, "fanuc-30i");
  EXPECT_EQ(vote.decide(neutral).basis, GuessBasis::Neighbours);
  EXPECT_EQ(vote.decide(neutral).dialect->machine, MachineKind::Turning);
  EXPECT_EQ(vote.decide(clear).dialect->id, "haas-ngc");
  EXPECT_EQ(vote.decide(clear).basis, GuessBasis::Text);

  FolderVote foreign(allDialects());
  foreign.add(guessOf("DEF INT N1\nDEF REAL N2\nR1=5\nM17\n"));
  foreign.add(guessOf("DEF INT N3\nDEF REAL N4\nR2=5\nM17\n"));
  const LanguageGuess plain = guessOf("G0 X1 Y2\nM30\n");
  foreign.add(plain);
  ASSERT_NE(foreign.decide(plain).foreign, nullptr);
  EXPECT_EQ(foreign.decide(plain).foreign->name, "Sinumerik");
}

TEST(Guess, GCodeSystemOfALathe) {
  const auto systemOf = [](std::string_view blocks) {
    const std::string text = fmt::format("O1\nT0101\nG96 S180 M03\n{}M30\n", blocks);
    const LanguageGuess guess = guessLanguage(text, "", allDialects());
    EXPECT_EQ(guess.dialect->id, "fanuc-30i-lathe") << text;
    return guess.gCodeSystem ? nameOf(*guess.gCodeSystem) : "none";
  };
  EXPECT_EQ(systemOf("G99 G01 X50. Z2. F.2\n"), "A");
  EXPECT_EQ(systemOf("G90 X48. Z-20. F.2\nX46.\n"), "A");
  EXPECT_EQ(systemOf("G92 X20. Z-20. F1.5\n"), "A");
  EXPECT_EQ(systemOf("G0 U-2. W1.\n"), "A");
  EXPECT_EQ(systemOf("G90 G95 G00 X50. Z2.\nG01 Z-20. F.2\n"), "B");
  EXPECT_EQ(systemOf("G90 G94\nG00 X50. Z2.\nG01 Z-20. F200.\n"), "B");
  EXPECT_EQ(systemOf("G95\nG00 X50. Z2.\nG77 X48. Z-20. F.2\n"), "B");
  EXPECT_EQ(systemOf("G90 G95\nG71 U2. R1.\nG71 P10 Q20 U.4 W.1 F.3\nN10 G00 X20.\nN20 Z-5.\nG98 G83 Z-20. F.1\n"),
            "B");
  EXPECT_EQ(systemOf("G71 G90 G95\nG00 X50. Z2.\nG20 X48. Z-20. F.2\n"), "C");
  EXPECT_EQ(systemOf("G90 G95 G00 X50. Z2.\nG24 X20. Z-1. F.2\n"), "C");
  // too little, or marks of several
  EXPECT_EQ(systemOf("G00 X50. Z2.\nG01 Z-20. F.2\n"), "none");
  EXPECT_EQ(systemOf("G90\nG00 X50. Z2.\n"), "none");
  EXPECT_EQ(systemOf("G90 X50. Z2.\n"), "none");
  EXPECT_EQ(systemOf("G90 G95 G00 X50. Z2.\nG01 W-20. F.2\n"), "none");
  EXPECT_EQ(systemOf("G04 U1.\nG98\n"), "none");
}

TEST(Guess, TheFolderTellsTheGCodeSystem) {
  const auto guessOf = [](std::string_view text) { return guessLanguage(text, "", allDialects()); };
  const LanguageGuess neutral = guessOf("O1\nT0101\nG96 S180\nG00 X50. Z2.\nM99\n");
  const LanguageGuess b = guessOf("O2\nG92 S2000\nT0101\nG96 S180\nG90 G95 G00 X50. Z2.\nM30\n");
  const LanguageGuess a = guessOf("O3\nG50 S2000\nT0101\nG96 S180\nG99 G01 X50. Z2. F.2\nM30\n");
  FolderVote vote(allDialects());
  vote.add(neutral);
  vote.add(b);
  EXPECT_EQ(vote.decide(neutral).gCodeSystem, GCodeSystem::B);
  EXPECT_EQ(vote.decide(a).gCodeSystem, GCodeSystem::A);
  vote.add(a);
  EXPECT_EQ(vote.decide(neutral).gCodeSystem, std::nullopt);
}

TEST(Guess, MachinesThatAreNotForNcPrograms) {
  EXPECT_EQ(guessed("CLOSE\nOPEN PROG 12\nCLEAR\nLINEAR\nABS\nX10Y20\nDWELL0\nCLOSE\n"),
            "a program for a PMAC motion controller (Delta Tau)");
  EXPECT_EQ(guessed("M48\nINCH,TZ\nT1C0.0310\n%\nT1\nX0100Y0100\nM30\n"), "an Excellon drill file");
  EXPECT_EQ(guessed("$DO0.0=1\nG1 X10 F20\n$DO0.0=0\nDVAR $gap\n"), "AeroBasic of an Aerotech controller");
}

TEST(Guess, LabelsByP) {
  const std::string contour = "P10 G01 X20 Z0\nZ-15\nP20 X60\nG70 P10 Q20\nM30\n";
  EXPECT_EQ(guessed("G96 S120 M3\nG71 P10 Q20 D2. F0.2\n" + contour),
            "a program for a simulator whose labels are P words");
  EXPECT_NE(guessed("G96 S120 M3\nG71 P10 Q30 D2. F0.2\n" + contour),
            "a program for a simulator whose labels are P words");
}

TEST(Guess, OneStrayWordRefusesNothing) {
  EXPECT_EQ(guessed("M303 E0 C8 S210\nAuto-tune at 210 C for 8 cycles:\nG28\nG90\nM303 for 8 cycles:\n"), "fanuc-30i");

  EXPECT_EQ(guessed("O1\n#1=5\nIF[#1==5]GOTO10\nN10G0X1.\nM30\n"), "fanuc-30i");
  EXPECT_EQ(guessed("O1(MSG, CHECK)\n#1=5\nG65P9000A#1\nM30\n"), "fanuc-30i");
}

TEST(Guess, TextsThatAreNoPrograms) {
  EXPECT_EQ(guessed(""), "none");
  EXPECT_EQ(guessed("This is a letter about the machine.\nIt has seven lines, and no program.\n"), "none");
  EXPECT_EQ(guessed("# Heading\n\nText with code:\n\n```nc\nO1\nG0 X1.\nM30\n```\n", "notes.txt"), "none");
  EXPECT_EQ(guessed("%\nO1\nG0 X1.\nM30\n%\n", "README.md"), "none");
  EXPECT_EQ(guessed("#include <vector>\nint main() { return 0; }\n", "x.txt"), "none");
  EXPECT_EQ(guessed("int main(int n) {\n  if (n == 2) return 3;\n  else return process(n);\n}\n", "x.txt"), "none");
  EXPECT_EQ(guessed("def f(x):\n    # a comment == b\n    return x == 2 and x != 3\n", "x.txt"), "none");
  EXPECT_EQ(guessed("time,load\n1.5,20\n2.5,30\n", "x.txt"), "none");
  EXPECT_EQ(guessed("{\"name\": 5, \"list\": [1, 2]}\n", "x.txt"), "none");
  EXPECT_EQ(guessed("<!DOCTYPE html>\n<p>G0 X1</p>\n", "x.txt"), "none");
  EXPECT_EQ(guessed(std::string("\x7F"
                                "ELF\x02\x01\x01\x03\x05\x06\x07\x08",
                                12),
                    "x.nc"),
            "none");
}

TEST(Guess, OddBytesOfAProgramDoNoHarm) {
  EXPECT_EQ(guessed(std::string(40, '\0') + "%\nO1(\x83\x65\x83\x58)\nG0 X1.\r\nM30\n\x1A"), "fanuc-30i");
  EXPECT_EQ(guessed("\xEF\xBB\xBF%\nO1\nG0 X1.\nM30\n"), "fanuc-30i");
  EXPECT_EQ(guessed("(A (NESTED) REMARK: with words)\n(ANOTHER (ONE): again)\nG0 X1.\nM30\n"), "fanuc-30i");
  EXPECT_EQ(guessed("DPRNT[RESULT*OF*THIS*X#1[44]]\nM30\n"), "fanuc-30i");
}

TEST(Guess, ReasonsComeStrongestFirst) {
  const LanguageGuess guess = guessLanguage("O00012\n#1=2\nM97 P1\nM97 P2\nM30\n", "", allDialects());
  ASSERT_GE(guess.reasons.size(), 2U);
  EXPECT_EQ(guess.reasons.front(), descriptionOf(TextSignal::HaasLocalCall));
}

TEST(TextScan, CountsSignals) {
  const TextScan scan = scanText("#1=2\n#2=[#1+#100]\nG65 P9000 A1.\n(note)\nprose of several words\n", "");
  EXPECT_EQ(scan.count(TextSignal::HashVariable), 4U);
  EXPECT_EQ(scan.count(TextSignal::MacroCall), 1U);
  EXPECT_EQ(scan.programLines, 3U);
  EXPECT_EQ(scan.otherLines, 1U);
}

TEST(TextScan, JammedKeywordsAreKeywordsButPartsOfWordsAreNot) {
  EXPECT_EQ(scanText("IF[#1EQ2]THENGOTO5\n", "").count(TextSignal::MacroControl), 2U);
  EXPECT_EQ(scanText("process domain endless\n", "").count(TextSignal::MacroControl), 0U);
}

} // namespace
} // namespace feedhold
