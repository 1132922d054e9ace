"""Programs that are hard to prove, or hard to give up on, of any size: each function takes a size in bytes."""


def repeated(block, size):
    """The block over and over; `{i}` in it counts."""
    blocks, length, i = [], 0, 0
    while length < size:
        blocks.append(block.replace("{i}", str(i)).replace("{n}", str(i % 30 + 1)) + "\n")
        length += len(blocks[-1])
        i += 1
    return "".join(blocks)


def program(body, contract="", end="M30"):
    return f"%\nO1\n{contract}{body}{end}\n%\n"


# ---- values that grow ----

def squares(size):
    return program(repeated("#1=#1*#1+1", size) + "#2=1/#1\n")


def squares_of_a_number(size):
    return program("#1=1.1\n" + repeated("#1=#1*#1", size) + "#2=1/[#1-7]\n")


def logistic_map(size):
    return program(repeated("#1=3.9*#1*[1-#1]", size) + "#2=1/#1\n")


def logistic_map_of_a_number(size):
    return program("#1=.3\n" + repeated("#1=3.9*#1*[1-#1]", size) + "#2=1/#1\n")


def logistic_loop(size):
    return program(f"#1=.3\n#2=0\nWHILE[#2LT{size}]DO1\n#1=3.9*#1*[1-#1]\n#2=#2+1\nEND1\n#3=1/#1\n")


def logistic_loop_of_an_argument(size):
    return program(f"#2=0\nWHILE[#2LT{size}]DO1\n#1=3.9*#1*[1-#1]\n#2=#2+1\nEND1\n#3=1/#1\n")


def sums_of_all(size):
    return program(repeated("#1=#1*2+#2*3\n#2=#2+#1*#3", size) + "#4=1/[#1-#2]\n")


def fibonacci_products(size):
    return program(repeated("#3=#1*#2\n#1=#2\n#2=#3", size) + "#4=1/#3\n")


def deep_product(size):
    factors = "*".join(f"[#{100 + i}+{i}]" for i in range(20))
    return program(repeated(f"#1={factors}\n#2=1/#1", size))


def deep_sum(size):
    terms = "+".join(f"#{100 + i}*{i + 1}" for i in range(20))
    return program(repeated(f"#1=#1*2+{terms}\n#2=1/#1", size))


def deep_brackets(size):
    return program(repeated("#1=" + "[" * 5 + "#1+1" + "]*#2" * 5, size) + "#2=1/#1\n")


def huge_exponents(size):
    return program(repeated("#1=POW[#1,100]", size) + "#2=1/#1\n#3=POW[1.1,99999999]\n#4=1/#3\n")


def huge_exponential(size):
    return program("#1=1.5\n" + repeated("#1=EXP[#1]", size) + "#2=1/#1\n")


def roots(size):
    return program(repeated("#1=SQRT[ABS[#1*#1-2]]", size) + "#2=1/#1\n")


def roundings(size):
    return program(repeated("#1=FIX[#1*3/7]+ROUND[#2*1.5]\n#2=FUP[#1/3]", size) + "#2=1/#1\n")


def bits(size):
    return program(repeated("#1=[#1AND255]XOR[#2OR15]\n#2=BIN[#1]", size) + "#2=1/#1\n")


# ---- claims ----

SPACE = "(@PARAM #1 R 5..50)\n(@MODAL G90 G40 G49 G80 G21)\n(@START X0 Y0 Z50.)\n(@TOOL FLAT RADIUS 5)\n"


def divisions(size):
    return program(repeated("#1=1/[#1+1]", size))


def divisions_of_one(size):
    return program(repeated("#2=1/#1", size))


def divisions_by_products(size):
    return program(repeated("#2=1/[#1*#3-#4*#{n}]\n#{n}=#2+#1", size))


def quotients_of_arguments(size):
    return program(repeated("#{n}=[#1+#{n}]/[#2*#2+#3*#3+1]", size))


def sines(size):
    return program(repeated("#1=SIN[#1]+COS[#2]\n#2=1/[#1+3]", size))


def tables(size):
    return program(repeated("#2=#[100+#1]\n#[500+#2]=#1+{n}", size))


def regions(size):
    contract = SPACE + "".join(f"(@KEEPOUT B{i} BOX X{i * 20}..{i * 20 + 10} Y0..10 Z-10..0)\n" for i in range(20))
    return program("G17G0X0Y0Z50.\n" + repeated("G2X#1Y{n}R#1F100\nG1Z[#1+{n}]F100", size), contract)


def arcs(size):
    contract = SPACE + "(@KEEPOUT B BOX X100..200 Y100..200 Z-10..0)\n(@LIMIT F 1..90)\n(@CLEARANCE Z9)\n"
    return program("G17G0X0Y0Z50.\n" + repeated("G2X[#1*{n}]Y[{n}/#1]I#1J{n}F100", size), contract)


def promises(size):
    contract = "(@PARAM #1 A 1..9)\n" + repeated("(@ENSURE #100 GE #1*{n}-{i})", size)
    return program("#100=#1*#1\n", contract)


def requirements(size):
    contract = "(@PARAM #1 A 1..9)\n(@PARAM #2 B 1..9)\n" + repeated("(@REQUIRE #1*{n}+#2*{i} GT #2*#1-{i})", size)
    return program("#100=1/[#1-#2]\n", contract)


# ---- ways ----

def branches(size):
    return program(repeated("IF[#{n}GT{i}]GOTO1{i}\n#150=#150+#{n}\nN1{i}", size) + "#2=1/#150\n")


def branches_on_products(size):
    return program(repeated("IF[#{n}*#50GT{i}]GOTO1{i}\n#150=#150*#{n}\nN1{i}", size) + "#2=1/#150\n")


def jumps(size):
    return program(repeated("IF[#1EQ{i}]GOTO[#2]\nN{i}#1=#1+1", size))


def backward_jumps(size):
    return program(repeated("N{i}#{n}=#{n}+1\nIF[#{n}LT#150]GOTO{i}", size))


def jumps_among_all(size):
    labels = size // 30
    body = "".join(f"N{i + 1}#1=#1+#{i % 30 + 1}\nIF[#1LT#{i % 7 + 1}]GOTO{(i * 7919) % labels + 1}\n"
                   for i in range(labels))
    return program(body)


def skips(size):
    return program(repeated("/#1=#1+{n}\n/#2=#2*#1", size) + "#3=1/[#1-#2]\n")


# ---- loops and calls ----

def loops(size):
    return program(repeated("#{n}=0\nWHILE[#{n}LT#150]DO1\n#{n}=#{n}+#151\nEND1", size))


def nested_loops(size):
    body = "".join(f"#{i}=0\nWHILE[#{i}LT#{i + 10}]DO{i}\n#20=#20*#{i}+1\n" for i in (1, 2, 3))
    body += "".join(f"#{i}=#{i}+#{i + 20}\nEND{i}\n" for i in (3, 2, 1))
    return program(repeated(body, size) + "#4=1/#20\n")


def counted_loops(size):
    return program(repeated("#1=0\nWHILE[#1LT9999]DO1\n#1=#1+1\n#2=#2*1.1+#1\nEND1", size) + "#3=1/#2\n")


def large_loop(size):
    return program("WHILE[#1LT#2]DO1\n" + repeated("#{n}=#{n}+#1*#2", size) + "#1=#1+1\nEND1\n")


def large_loop_with_branches(size):
    body = repeated("IF[#{n}GT#1]GOTO1{i}\n#{n}=#{n}+#3\nN1{i}", size)
    return program(f"WHILE[#1LT#2]DO1\n{body}#1=#1+1\nEND1\n")


def loop_of_swaps(size):
    body = repeated("#33=#{n}\n#{n}=#31\n#31=#33", size)
    return program(f"WHILE[#31NE#32]DO1\n{body}END1\n")


def calls(size):
    return program(repeated("G65P2A#{n}B[#1+{i}]", size), end="M30\nO2\n#100=#100+1/#1\nIF[#2GT#1]GOTO5\n#100=#2\nN5M99")


def doubling_calls(size):
    programs = "".join(f"O{i}\n" + "".join(f"G65P{i + 1}A[#1+{k}]\n" for k in range(12)) + "M99\n" for i in (2, 3, 4))
    return program(repeated("G65P2A#{n}", size), end=f"M30\n{programs}O5\n#100=#100+1/#1\nM99")


def repeated_calls(size):
    return program(repeated("M98P2L9999", size), end="M30\nO2\n#100=#100*#100+1\n#101=1/#100\nM99")


def modal_calls(size):
    return program("G66P2A1.\n" + repeated("X#{n}Y{i}.", size) + "G67\n", end="M30\nO2\n#100=#100+#1/#101\nM99")


def recursion(size):
    return program(repeated("M98P1", size))


# ---- plain ----

def moves(size):
    return program("G90G54G17G0\n" + repeated("G1X{i}.Y{n}.F100", size))


def incremental_moves(size):
    return program("G91\n" + repeated("G1X#{n}Y#1F100", size), SPACE + "(@KEEPOUT B BOX X100..200 Y100..200 Z-10..0)\n")


def alarms(size):
    return program(repeated("IF[#{n}LT{i}]GOTO90\n#{n}=#{n}*2+#150", size), end="M30\nN90#3000=1(A)\nM30")


def many_programs(size):
    return "%\n" + repeated("O{i}\nIF[#1EQ0]GOTO5\n#100=#3/[#1*#2+1]\nN5M99", size).replace("O0\n", "O9999\n") + "%\n"


def many_loops_in_many_programs(size):
    text = "O{i}\nWHILE[#1LT#2]DO1\n#1=#1*#3+#4\n#2=#2+#5/#1\nEND1\nM99"
    return "%\n" + repeated(text, size).replace("O0\n", "O9999\n") + "%\n"


def travels(size):
    return "%\nO1\n" + repeated("(@TRAVEL X-{i}.. {n} Y..{i} Z.. .5)", size) + "G0X1Y1Z-1\nM30\n%\n"


ALL = [function for name, function in sorted(globals().items())
       if callable(function) and name not in ("repeated", "program")]
