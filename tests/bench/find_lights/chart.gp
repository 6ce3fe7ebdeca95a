# Draws the chart: gnuplot -c chart.gp FOLDER, where bench_lights left lights.md. Colours: Okabe and Ito 2008.
# Cost and error of the row that begins with `way`; its columns count from 1 after the name.
row(way, cost, error) = sprintf("< awk -F' *[|] *' 'index($2, \"%s\") == 1 { print $%d, $%d }' '%s/lights.md'", way, cost + 2, error + 2, ARG1)
level(way, error) = real(system(sprintf("awk -F' *[|] *' 'index($2, \"%s\") == 1 { print $%d }' '%s/lights.md'", way, error + 2, ARG1)))
set terminal svg size 1200,420 font "DejaVu Sans,11" background "white" noenhanced
set output ARG1 . "/lights.svg"
set grid linecolor rgb "#d0d0d0" linewidth 0.7
set border linecolor rgb "#606060"
set tics scale 0.6
set logscale x
set key top right samplen 1.5 font ",9"
set multiplot layout 1,3
set title "Light sources in frames"
set xlabel "us a frame, one core"
set ylabel "off, degrees, median of those found"
set xrange [1:100000]
set yrange [0:5]
plot row("**ours**", 6, 1) using 1:2 with points linecolor rgb 0xD55E00 pointtype 7 pointsize 1.2 title "Shoal", \
    row("the thesis", 6, 1) using 1:2 with points linecolor rgb 0x56B4E9 pointtype 13 pointsize 1.4 title "the thesis"
set title "Photos of 65 degrees grown to panoramas"
set xlabel "ms of processor a photo"
set ylabel "diffuse light off, %, median"
set xrange [0.1:10000]
set yrange [0:*]
plot row("stretched", 7, 1) using 1:2 with points linecolor rgb 0x0072B2 pointtype 5 pointsize 1.2 title "stretched; hollow: the light not in it", \
    row("stretched", 7, 4) using 1:2 with points linecolor rgb 0x0072B2 pointtype 4 pointsize 1.2 notitle, \
    row("carved to", 7, 1) using 1:2 with points linecolor rgb 0x56B4E9 pointtype 13 pointsize 1.4 title "the thesis: carved to the poles", \
    row("carved to", 7, 4) using 1:2 with points linecolor rgb 0x56B4E9 pointtype 12 pointsize 1.4 notitle, \
    row("**carved", 7, 1) using 1:2 with points linecolor rgb 0xD55E00 pointtype 7 pointsize 1.2 title "Shoal: carved, poles extrapolated", \
    row("**carved", 7, 4) using 1:2 with points linecolor rgb 0xD55E00 pointtype 6 pointsize 1.2 notitle
set title "Attenuation of the films' water"
set xlabel "us a frame, one core"
set ylabel "light off at 1 to 3 m, %"
set xrange [1:10000]
set yrange [0:*]
set logscale y
set yrange [1:100]
plot level("reef", 3) with lines linecolor rgb 0x000000 linewidth 2 title "without", \
    level("reef", 4) with lines linecolor rgb 0x0072B2 dashtype 2 linewidth 1.5 title "the same water for all: reef, night", \
    level("kelp", 4) with lines linecolor rgb 0x009E73 dashtype 2 linewidth 1.5 title "the same water for all: kelp", \
    row("reef", 6, 5) using 1:2 with points linecolor rgb 0xD55E00 pointtype 7 pointsize 1.2 title "Shoal, found: reef", \
    row("night", 6, 5) using 1:2 with points linecolor rgb 0xD55E00 pointtype 5 pointsize 1.2 title "Shoal, found: night", \
    row("kelp", 6, 5) using 1:2 with points linecolor rgb 0xD55E00 pointtype 9 pointsize 1.4 title "Shoal, found: kelp"
unset multiplot
