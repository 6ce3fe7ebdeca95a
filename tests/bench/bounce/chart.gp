# Draws the chart: gnuplot -c chart.gp FOLDER, where bench_bounce left bounce.tsv. Colours: Okabe and Ito 2008.
rows(way, far) = sprintf("< awk -F'\\t' '$1 == \"reef, tunnel\" && $2 == \"light of the film\" && $3 == \"%s\" && $5 == %d' %s/bounce.tsv", way, far, ARG1)
level(way) = real(system(sprintf("awk -F'\\t' '$1 == \"reef, tunnel\" && $2 == \"light of the film\" && $3 == \"%s\" { print $7 }' %s/bounce.tsv", way, ARG1)))
set terminal svg size 620,420 font "DejaVu Sans,12" background "white"
set output ARG1 . "/bounce.svg"
set datafile separator "\t"
set grid linecolor rgb "#d0d0d0" linewidth 0.7
set border linecolor rgb "#606060"
set tics scale 0.6
set title "Diffuse light of animals in the reef's tunnel" font ",14"
set xlabel "processor time of a place, us"
set ylabel "error, %, median"
set logscale x
set xrange [1:100]
set yrange [0:110]
set key top right samplen 1.5
plot level("camera") with lines linecolor rgb 0x000000 linewidth 2 title "the camera's light ", \
    level("bound: best gain") with lines linecolor rgb 0x000000 dashtype 2 title "bound: the best gain of that", \
    level("bound: true, 9 harmonics") with lines linecolor rgb 0x000000 dashtype 3 title "bound: true, 9 harmonics", \
    rows("rays", 4) using 18:7 with linespoints linecolor rgb 0xD55E00 pointtype 7 pointsize 1.2 title "Shoal: rays in 144 directions, 4 m"
