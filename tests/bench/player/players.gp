# Histograms of catches a dive, by player: gnuplot -c players.gp FOLDER
folder = ARG1
set terminal svg size 1000,640 font "sans,13" background "white"
set output folder."/players.svg"
set datafile separator "\t"
set multiplot layout 2,3 title "Fish caught in a dive of 90 s: the share of dives; grey: the goal"
set style fill solid 0.8 noborder
set boxwidth 0.9
set xrange [-0.5:24.5]
set yrange [0:0.32]
set xtics 0,4
set format y "%.0f %%"
set ytics ("0 %%" 0, "10 %%" 0.1, "20 %%" 0.2, "30 %%" 0.3)
set grid ytics lc rgb "#dddddd"
unset key
players = "'mouse, novice' 'mouse, practised' 'mouse, practised, assist none' 'hands, novice' 'hands, practised' 'hands, practised, assist none'"
lows = "4 10 4 4 10 4"
highs = "24.5 18 24.5 24.5 18 24.5"
do for [i = 1:6] {
    name = word(players, i)
    set title name
    low = real(word(lows, i)) - 0.5
    high = real(word(highs, i)) + 0.5
    set object 1 rectangle from low, 0 to (high > 24.5 ? 24.5 : high), 0.32 fc rgb "#eeeeee" behind
    rows = sprintf("< awk -F'\t' '$1 == \"%s\"' %s/players.tsv", name, folder)
    dives = real(system(substr(rows, 3, strlen(rows))." | wc -l"))
    plot rows using 3:(1.0 / dives) smooth frequency with boxes lc rgb (i > 3 ? "#0072b2" : "#d55e00")
}
