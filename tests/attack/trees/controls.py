"""Facts about controls that programs of these tests depend on."""
from dataclasses import dataclass


@dataclass(frozen=True)
class Control:
    dialect: str
    macro_nesting: int  # levels of G65, G66 that are open at once
    total_nesting: int
    has_modal_calls: bool = True
    repeats_keep_locals: tuple = (True, False)  # of G65 L: not said by FANUC; Haas keeps
    local_subroutines: bool = False  # M97 P
    last_alarm_number: int = 200
    loop_numbers: int = 3
    fanuc_offsets: bool = True  # several numbers for one offset


CONTROLS = {
    "fanuc-30i": Control("fanuc-30i", 5, 15),
    "fanuc-0i": Control("fanuc-0i", 4, 8),
    "mitsubishi-m700": Control("mitsubishi-m700", 4, 8, last_alarm_number=9999, loop_numbers=127,
                               fanuc_offsets=False),
    "haas-ngc": Control("haas-ngc", 4, 9, has_modal_calls=False, repeats_keep_locals=(True,), local_subroutines=True,
                        last_alarm_number=999),
}

LETTER_TO_LOCAL = dict(A=1, B=2, C=3, D=7, E=8, F=9, H=11, I=4, J=5, K=6, M=13, Q=17, R=18, S=19, T=20, U=21, V=22,
                       W=23, X=24, Y=25, Z=26)
LOCAL_TO_LETTER = {number: letter for letter, number in LETTER_TO_LOCAL.items()}

AXES = "XYZ"


def canonical(number: int) -> int:
    """Of several numbers of one cell, one.  FANUC milling: #2001.. is #10001.., #2501.. is #5221.. and so on."""
    if 2001 <= number <= 2400:
        first = 2001 if number <= 2200 else 2201
        return (10001 if number <= 2200 else 11001) + number - first
    if 2500 <= number <= 2806 and number % 100 <= 6:
        axis = (number - 2500) // 100
        return 5201 + 20 * (number % 100) + axis
    if 7001 <= number <= 7960:
        return number + 7000
    return number


def is_bit_of_outputs(number: int) -> bool:
    return 1100 <= number <= 1131


def is_work_offset(number: int) -> bool:
    return 5201 <= number <= 5326


ALL_OUTPUTS = 1132


def is_local(number: int) -> bool:
    return 1 <= number <= 33


def is_common(number: int) -> bool:
    return 100 <= number <= 199 or 500 <= number <= 999


def is_offset(number: int) -> bool:
    """Of a canonical number: tool and work offsets that may be read and written."""
    return 10001 <= number <= 10200 or 11001 <= number <= 11200 or \
        (5201 <= number <= 5326 and (number - 5201) % 20 < 3) or \
        (14001 <= number <= 14960 and (number - 14001) % 20 < 3)


# Codes in force after power-on; 3402 and others decide some of these on a machine.
POWER_ON = {1: "G0", 2: "G17", 3: "G90", 5: "G94", 6: "G21", 7: "G40", 8: "G49", 9: "G80", 10: "G98", 11: "G50",
            13: "G97", 14: "G54", 15: "G64", 16: "G69"}

GROUP_OF = {}
for _group, _codes in {1: "G0 G1 G2 G3", 2: "G17 G18 G19", 3: "G90 G91", 5: "G94 G95", 6: "G20 G21", 7: "G40 G41 G42",
                       8: "G43 G44 G49", 9: "G73 G76 G80 G81 G82 G83 G84 G85 G86 G89", 10: "G98 G99", 11: "G50 G51",
                       13: "G96 G97", 14: "G54 G55 G56 G57 G58 G59", 15: "G61 G64", 16: "G68 G69"}.items():
    for _code in _codes.split():
        GROUP_OF[_code] = _group
