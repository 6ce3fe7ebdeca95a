# Draws the chart: gnuplot -c chart.gp FOLDER, where bench_contact left contact.tsv. Colours: Okabe and Ito 2008.
# Cost and mean of a measure of the methods whose names match, no mean below the lower edge.
rows(names) = sprintf("< awk -F'\\t' -v least=%g '$1 ~ /^%s$/ { if ($5 == \"cost, times ours\") cost[$1] = $6; if ($2 \"\\t\" $5 == \"%s\") { sum[$1] += $6 * $7; count[$1] += $7 } if (!seen[$1]++) name[++n] = $1 } END { for (i = 1; i <= n; ++i) { mean = sum[name[i]] / count[name[i]]; print cost[name[i]] \"\\t\" (mean < least ? least : mean) } }' '%s/contact.tsv'", least, names, measure, ARG1)
set terminal svg size 1000,860 font "DejaVu Sans,11" background "white" noenhanced
set output ARG1 . "/contact.svg"
set datafile separator "\t"
set grid linecolor rgb "#d0d0d0" linewidth 0.7
set border linecolor rgb "#606060"
set tics scale 0.6
set logscale xy
set xrange [0.7:60<*]
set xtics (1, 2, 5, 10, 20, 50, 100)
set xlabel "cost of forty fish and two fists, of ours"
array measures[4] = ["strike\tfirst touch, ms", "strike\tpassed through, %", "strike\toff its place, mm", "squeezed\tspat out, %"]
array titles[4] = ["Strikes: first touch, ms off", "Strikes that pass through, %", "Strikes: fish off its place, mm", "Held fish that are spat out, %"]
array leasts[4] = [0.01, 0.1, 0.5, 0.1]
array mosts[4] = [50000, 150, 300, 150]
set multiplot layout 2,2 title "Contacts between bones and fish: error over cost; 0 lies on the lower edge" font ",13"
do for [i = 1:4] {
    measure = measures[i]
    least = leasts[i]
    set title titles[i]
    set yrange [least:mosts[i]]
    if (i == 1) { set key top right samplen 2 font ",10" } else { unset key }
    plot rows("capsules, [0-9]+ steps?") with linespoints linecolor rgb 0x0072B2 linewidth 1.5 pointtype 5 title "Bullet, capsules: 1, 4, 16 steps", \
        rows("capsules, continuous") with points linecolor rgb 0x0072B2 linewidth 1.5 pointtype 4 pointsize 1.8 title "the same, 1 step, continuous", \
        rows("capsules, 4 steps, in metres") with points linecolor rgb 0x0072B2 pointtype 1 linewidth 2 title "the same, 4 steps, in metres", \
        rows("ellipsoids, [0-9]+ steps?") with linespoints linecolor rgb 0x009E73 linewidth 1.5 pointtype 9 title "Bullet, ellipsoids: 1, 4, 16 steps", \
        rows("ellipsoids, 4 steps, in metres") with points linecolor rgb 0x009E73 pointtype 1 linewidth 2 title "the same, 4 steps, in metres", \
        rows("Shoal") with points linecolor rgb 0xD55E00 pointtype 7 pointsize 1.3 title "Shoal", \
        rows("Shoal, moved at once") with points linecolor rgb 0xD55E00 linewidth 1.5 pointtype 6 pointsize 2 title "Shoal, moved at once", \
        rows("Shoal, every pair") with points linecolor rgb 0xE69F00 pointtype 7 title "Shoal, every pair"
}
unset multiplot
