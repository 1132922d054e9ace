(LinuxCNC: a row of cuts, deeper by 0.1 each)
G21 G90 G94 G17
G0 X0 Y0 Z5
#<depth>=0.0
o100 while [#<depth> LE 0.3]
G1 Z[0-#<depth>] F100
G1 X10 F200
G0 Z5
G0 X0
#<depth>=[#<depth>+0.1]
o100 endwhile
M2
