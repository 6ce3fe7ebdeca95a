# Draws the chart: gnuplot -c chart.gp FOLDER, where bench_parallax left parallax.tsv. Colours: Okabe and Ito 2008.
rows(way) = sprintf("< awk -F'\\t' '$1 == \"%s\" && $3 == 0 && $4 == 0' %s/parallax.tsv | sort -n -k2", way, ARG1)
set terminal svg size 620,420 font "DejaVu Sans,12" background "white"
set output ARG1 . "/parallax.svg"
set datafile separator "\t"
set grid linecolor rgb "#d0d0d0" linewidth 0.7
set border linecolor rgb "#606060"
set tics scale 0.6
set title "A film with distances, seen from beside its camera" font ",14"
set xlabel "eye to the right of the camera, mm"
set ylabel "PSNR to the true picture, dB"
set xrange [0:320]
set key top right samplen 1.5
plot rows("cells") using 2:5 with linespoints linecolor rgb 0x000000 linewidth 2 pointtype 7 title "Shoal: search at cells' corners", \
    rows("search") using 2:5 with linespoints linecolor rgb 0x0072B2 pointtype 5 title "search for each pixel", \
    rows("grid_1024") using 2:5 with linespoints linecolor rgb 0xD55E00 pointtype 9 title "displaced grid of 1024 x 512", \
    rows("grid_256") using 2:5 with linespoints linecolor rgb 0xE69F00 pointtype 9 title "displaced grid of 256 x 128", \
    rows("flat") using 2:5 with linespoints linecolor rgb 0xCC79A7 pointtype 3 title "the film as it is"
