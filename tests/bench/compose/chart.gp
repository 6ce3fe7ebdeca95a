# Draws the chart: gnuplot -c chart.gp FOLDER, where bench_compose left compose.tsv. Colours: Okabe and Ito 2008.
file = ARG1 . "/compose.tsv"
ways = "< awk -F'\\t' 'NR == 1 || $2 > 0' " . file
again(column) = real(system("awk -F'\\t' '$1 == \"filmed again\" { print $" . column . " }' " . file))
plain(column) = real(system("awk -F'\\t' '$1 == \"plain\" { print $" . column . " }' " . file))

set terminal svg size 900,430 font "DejaVu Sans,12" background "white"
set output ARG1 . "/compose.svg"
set datafile separator "\t"
set grid linecolor rgb "#d0d0d0" linewidth 0.7
set border linecolor rgb "#606060"
set tics scale 0.6
set yrange [0:*]
set offsets graph 0.15, graph 0.15, graph 0.1, 0
set xlabel "processor time of a frame at 1280x720, of plain's"
unset key
shape(name) = name eq "plain" ? 5 : name eq "resolution" ? 7 : name eq "texels" ? 9 : 13
tint(name) = name eq "plain" ? 0x000000 : name eq "resolution" ? 0x0072B2 : name eq "texels" ? 0x009E73 : 0xD55E00
set multiplot layout 1,2 title "Objects beside the same objects filmed: lower is more seamless" font ",14"
do for [panel = 1:2] {
    column = panel == 1 ? 8 : 9
    set ylabel panel == 1 ? "luma's distance beyond filming again, of 255" : "distance of power spectra, dB"
    set arrow 1 from graph 0, first plain(column) / 2 to graph 1, first plain(column) / 2 nohead dashtype 2 linecolor rgb "#606060"
    set label 1 "half of plain's" at graph 0.02, first plain(column) / 2 left offset 0,0.5 textcolor rgb "#606060" font ",10"
    if (panel == 2) {
        set arrow 2 from graph 0, first again(column) to graph 1, first again(column) nohead dashtype 3 linecolor rgb "#606060"
        set label 2 "filmed again" at graph 0.98, first again(column) right offset 0,0.5 textcolor rgb "#606060" font ",10"
    }
    plot ways using 5:column:(shape(strcol(1))):(tint(strcol(1))) every ::1 with points pointsize 1.4 pointtype variable linecolor rgb variable, \
         "" using 5:column:(strcol(1) eq "camera" ? "" : strcol(1)) every ::1 with labels center offset 0,0.9 font ",11", \
         "" using 5:column:(strcol(1) eq "camera" ? strcol(1) : "") every ::1 with labels left offset 1,0 font ",11"
}
unset multiplot
