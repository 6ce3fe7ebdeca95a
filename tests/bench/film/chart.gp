# Draws the chart: gnuplot -c chart.gp FOLDER, where bench_film left film.tsv. Colours: Okabe and Ito 2008.
rows(codec, width) = sprintf("< awk -F'\\t' '$1 == \"%s\" && $2 == %d' %s/film.tsv | sort -n -k4", codec, width, ARG1)
base = real(system("awk -F'\\t' '$1 == \"first\" { print $5 }' " . ARG1 . "/film.tsv"))
wanted = 1.5 * real(system("awk -F'\\t' '$1 == \"first\" { print $9 }' " . ARG1 . "/film.tsv"))

set terminal svg size 980,430 font "DejaVu Sans,12" background "white"
set output ARG1 . "/film.svg"
set datafile separator "\t"
set grid linecolor rgb "#d0d0d0" linewidth 0.7
set border linecolor rgb "#606060"
set tics scale 0.6
set key outside right top font ",10" samplen 1.5
tint(codec) = codec eq "h264" ? 0x000000 : codec eq "hevc" ? 0x0072B2 : 0xD55E00
shape(width) = width == 2048 ? 7 : width == 3072 ? 5 : 9
set multiplot layout 1,2 title "The film in three codecs and sizes" font ",14"
set xlabel "decoding of a frame on one thread, of the first film's"
set ylabel "detail that is half kept, cycles around"
set yrange [0:*]
set xrange [0:*]
unset key
set arrow 2 from graph 0, first wanted to graph 1, first wanted nohead dashtype 2 linecolor rgb "#606060"
set label 2 "1.5 times the first film's" at graph 0.98, first wanted right offset 0,-0.6 textcolor rgb "#606060" font ",10"
plot rows("first", 2048) using ($5 / base):9 with points linecolor rgb 0xCC79A7 pointtype 3 pointsize 1.5, \
    for [codec in "h264 hevc av1"] for [width in "2048 3072 4096"] rows(codec, int(width)) using ($5 / base):9 \
    with linespoints linecolor rgb tint(codec) pointtype shape(int(width)) title codec . " " . width
set key
unset arrow 2
unset label 2
set xlabel "a film of a minute, MB"
set ylabel "error in linear light, %"
set logscale x 2
set xrange [12:*]
set xtics (15, 20, 30, 45, 60, 90, 120)
set arrow 1 from 45, graph 0 to 45, graph 1 nohead dashtype 2 linecolor rgb "#606060"
plot rows("first", 2048) using 4:7 with points linecolor rgb 0xCC79A7 pointtype 3 pointsize 1.5 title "the first film", \
    for [codec in "h264 hevc av1"] for [width in "2048 3072 4096"] rows(codec, int(width)) using 4:7 \
    with linespoints linecolor rgb tint(codec) pointtype shape(int(width)) title codec . " " . width
unset multiplot
