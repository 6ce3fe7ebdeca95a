# Draws the chart: gnuplot -c chart.gp FOLDER, where bench_contact left contact.tsv. Colours: Okabe and Ito 2008.
rows(scene, measure) = sprintf("< awk -F'\\t' -v s='%s' -v m='%s' '$5 == \"cost, times ours\" { cost[$1] = $6; order[++n] = $1 } $2 == s && $5 == m { sum[$1] += $6 * $8; all[$1] += $8 } END { for (i = 1; i <= n; ++i) { v = sum[order[i]] / all[order[i]]; print order[i] \"\\t\" cost[order[i]] \"\\t\" (v < least ? least : v) } }' least=%s '%s/contact.tsv'", scene, measure, "%s", ARG1)
set terminal svg size 1000,820 font "DejaVu Sans,11" background "white" noenhanced
set output ARG1 . "/contact.svg"
set datafile separator "\t"
set grid linecolor rgb "#d0d0d0" linewidth 0.7
set border linecolor rgb "#606060"
set tics scale 0.6
set logscale xy
set xrange [0.8:150]
set xlabel "cost of forty fish and two fists, of ours"
unset key
shape(name) = name[1:5] eq "Shoal" ? 7 : name[1:3] eq "cap" ? 5 : 9
tint(name) = name[1:5] eq "Shoal" ? 0xD55E00 : strstrt(name, "metres") ? 0x909090 : name[1:3] eq "cap" ? 0x0072B2 : 0x009E73
panel(scene, measure, least) = sprintf(rows(scene, measure), least)
array scenes[4] = ["strike", "strike", "strike", "squeezed"]
array measures[4] = ["first touch, ms", "passed through, %", "off its place, mm", "spat out, %"]
array titles[4] = ["Strikes: first touch, ms off", "Strikes that pass through, %", "Strikes: fish off its place, mm", "Held fish that are spat out, %"]
array leasts[4] = ["0.01", "0.1", "1", "0.1"]
array mosts[4] = [30, 300, 1000, 300]
set multiplot layout 2,2 title "Contacts between bones and fish: error over cost; 0 is drawn at the lower edge" font ",13"
do for [i = 1:4] {
    set title titles[i]
    set yrange [real(leasts[i]) * 0.7:mosts[i]]
    data = panel(scenes[i], measures[i], leasts[i])
    plot data using 2:3:(shape(strcol(1))):(tint(strcol(1))) with points pointsize 1.2 pointtype variable linecolor rgb variable, \
         data using 2:3:1 with labels left offset 0.8,0.4 font ",9"
}
unset multiplot
