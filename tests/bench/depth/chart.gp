# Draws the chart: gnuplot -c chart.gp FOLDER, where bench_depth left depth.tsv. Colours: Okabe and Ito 2008.
rows(way, every, steps) = sprintf("< awk -F'\\t' '$1 == \"%s\" && $3 == %d && $4 == %d && $5 == 1024' %s/depth.tsv | sort -n -k2", way, every, steps, ARG1)
none = real(system("awk -F'\\t' '$1 == \"no occlusion\" { print $12 }' " . ARG1 . "/depth.tsv"))
set terminal svg size 760,430 font "DejaVu Sans,12" background "white"
set output ARG1 . "/depth.svg"
set datafile separator "\t"
set grid linecolor rgb "#d0d0d0" linewidth 0.7
set border linecolor rgb "#606060"
set tics scale 0.6
set key outside right top font ",10" samplen 1.5
set title sprintf("What depth tracks of 128, 256 and 512 around hide wrongly (without: %.0f %%)", none) font ",14"
set xlabel "all three films, MB"
set ylabel "fish that edges cross: wrongly hidden or shown, %"
set logscale x 2
set yrange [0:*]
films = "($6 + ($7 + $8) / 2)" # a minute of reef, half a minute each of night and kelp
set arrow 1 from 9, graph 0 to 9, graph 1 nohead dashtype 2 linecolor rgb "#606060"
plot rows("linear", 1, 1024) using (@films):($11 + $12) with linespoints linecolor rgb 0x000000 pointtype 7 title "linear, each frame", \
    rows("refined", 1, 1024) using (@films):($11 + $12) with linespoints linecolor rgb 0x0072B2 pointtype 7 title "refined, each frame", \
    rows("refined", 2, 16) using (@films):($11 + $12) with linespoints linecolor rgb 0xD55E00 pointtype 7 title "every second, 16 steps", \
    rows("refined", 4, 16) using (@films):($11 + $12) with linespoints linecolor rgb 0xCC79A7 pointtype 7 title "every fourth, 16 steps"
