# Draws the chart: gnuplot -c chart.gp FOLDER, where bench_bounce left bounce.tsv. Colours: Okabe and Ito 2008.
rows(way, far) = sprintf("< awk -F'\\t' '$1 == \"reef, tunnel\" && $2 == \"light of the film\" && $3 == \"%s\" && $5 == %d' %s/bounce.tsv", way, far, ARG1)
level(way) = real(system(sprintf("awk -F'\\t' '$1 == \"reef, tunnel\" && $2 == \"light of the film\" && $3 == \"%s\" { print $7 }' %s/bounce.tsv", way, ARG1)))
set terminal svg size 1080,420 font "DejaVu Sans,12" background "white"
set output ARG1 . "/bounce.svg"
set datafile separator "\t"
set grid linecolor rgb "#d0d0d0" linewidth 0.7
set border linecolor rgb "#606060"
set tics scale 0.6
set multiplot layout 1,2
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
set title "Waves' light on animals, over a second"
set key bottom right font ",14"
set ylabel "error, % of what a level sea lets through"
set xrange [0.1:100]
set yrange [0:70]
flicker(film) = sprintf("< awk -F'\\t' '$1 == \"%s\"' %s/caustics.tsv", film, ARG1)
# Below the picture if the film was not measured, as with --quick.
without(film) = real(system(sprintf("awk -F'\\t' 'BEGIN { error = -1 } $1 == \"%s\" { error = $3 } END { print error }' %s/caustics.tsv", film, ARG1)))
plot without("reef") with lines linecolor rgb 0x000000 linewidth 2 title "reef: evenly lit ", \
    without("kelp") with lines linecolor rgb 0x000000 dashtype 2 title "kelp: evenly lit", \
    flicker("reef") using 6:4 with points linecolor rgb 0xD55E00 pointtype 7 pointsize 1.2 title "reef: Shoal, by the film's ground", \
    flicker("kelp") using 6:4 with points linecolor rgb 0x0072B2 pointtype 5 pointsize 1.2 title "kelp: Shoal, by the film's ground"
unset multiplot
