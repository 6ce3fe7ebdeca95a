# Draws the chart: gnuplot -c occlusion.gp FOLDER, where bench_occlusion left occlusion.data.gp. Colours: Okabe and Ito
# 2008, "Color Universal Design"; shapes differ as well.
folder = ARG1
load folder . "/occlusion.data.gp"
colours = "#000000 #D55E00 #0072B2 #009E73 #56B4E9 #CC79A7 #E69F00 #000000 #D55E00 #0072B2"
shapes = "3 7 5 9 13 11 15 1 6 4"
set terminal svg size 900,1580 font "DejaVu Sans,12" background "white"
set output folder . "/occlusion.svg"
set multiplot
set logscale xy
set xtics () font ",11"; set ytics () font ",11"
do for [decade = 0:8] {
    set xtics add (sprintf(decade < 4 ? "%.0f" : decade < 7 ? "%.0f 000" : "%.0f 000 000", 10.0 ** (decade < 4 ? decade : decade < 7 ? decade - 3 : decade - 6)) 10.0 ** decade)
    do for [step in "1 2 5"] { set ytics add (sprintf("%g %%%%", int(step) * 10.0 ** decade / 100) int(step) * 10.0 ** decade / 100) }
}
set grid xtics ytics linecolor rgb "#d0d0d0" linewidth 0.7
set tics scale 0.6
set style textbox opaque margins 0.3,0.3 fillcolor "white" noborder # names hide the lines to their points
set border linecolor rgb "#606060"
set lmargin at screen 90 / 900.0; set rmargin at screen 890 / 900.0 # Report.cpp has the same size of the plot
set ylabel "error of diffuse light (relative root mean square)" offset 0.2
set xlabel "nanoseconds a shaded point, one core"
do for [panel = 1:2] {
    top = 1 - 590 / 1580.0 * (panel - 1)
    set tmargin at screen top - 120 / 1580.0; set bmargin at screen top - 530 / 1580.0
    eval sprintf("set xrange [left%d:right%d]; set yrange [low%d:high%d]", panel, panel, panel, panel)
    set label 1 value(sprintf("title%d", panel)) at screen 0.53,top - 14 / 1580.0 center font ",15"
    set key at screen 0.53,top - 73 / 1580.0 center center horizontal maxrows 4 samplen 0.5 width -4 font ",10"
    set arrow 1 from graph 0,first 5 to graph 1,first 5 nohead dashtype 3 linewidth 1.6 linecolor rgb "#606060"
    draw = "plot "
    do for [i = 1:words(families)] {
        draw = draw . sprintf("$points%d_%d using 1:2 with points pointtype %s pointsize 1.1 linecolor rgb '%s' title '%s', ", panel, i, word(shapes, i), word(colours, i), word(families, i))
    }
    draw = draw . sprintf("$labels%d using 1:2:(strcol(6) eq 'apart' ? $3-$1 : 0):(strcol(6) eq 'apart' ? $4-$2 : 0) with vectors nohead linecolor rgb '#808080' linewidth 0.7 notitle, ", panel)
    draw = draw . sprintf("$labels%d using 3:4:5 with labels center boxed font ',9' notitle", panel)
    eval draw
    unset label 1
}
# Layered fragment buffers in 256 directions: 54, 150 and 486 views from left to right.
unset arrow 1
set xlabel "MB of a scene's buffers"
set xtics auto; set xtics font ",11"; set format x "%g"
set xrange [*:*]; set yrange [1:20]
set label 1 "layered fragment buffers in 256 directions: 54, 150, 486 views" at screen 0.375,390 / 1580.0 center font ",13"
set key at screen 0.375,348 / 1580.0 center center vertical maxrows 4 samplen 2 width 0 font ",10"
set tmargin at screen 290 / 1580.0; set bmargin at screen 50 / 1580.0
do for [panel = 1:2] {
    set lmargin at screen (90 + 260 * (panel - 1)) / 900.0; set rmargin at screen (330 + 260 * (panel - 1)) / 900.0
    set title value(sprintf("title%d", panel)) font ",12" offset 0,-0.6
    if (panel == 2) { unset key; unset label 1; unset ylabel; set ytics ("" 1, "" 2, "" 5, "" 10, "" 20) }
    views(kind, pixels) = sprintf("$views%d_%s_%d using 1:2 with linespoints", panel, kind, pixels)
    eval "plot " . views("thesis", 32) . " pointtype 12 linecolor rgb '#56B4E9' title 'thesis, 32 pixels', " . \
        views("thesis", 64) . " pointtype 13 linecolor rgb '#56B4E9' title 'thesis, 64 pixels', " . \
        views("cured", 32) . " pointtype 10 linecolor rgb '#CC79A7' title 'cured, 32 pixels', " . \
        views("cured", 64) . " pointtype 11 linecolor rgb '#CC79A7' title 'cured, 64 pixels'"
}
# Shadows on the ground.
ground(name) = sprintf("< awk -F' *[|] *' '$2 ~ /^%s/ { print $4, $3 }' '%s/occlusion.md'", name, folder)
set label 1 "shadows on the ground" at screen 760 / 900.0,390 / 1580.0 center font ",13"
set key at screen 748 / 900.0,348 / 1580.0 center center vertical maxrows 4 samplen 2 width 0 font ",10"
set lmargin at screen 660 / 900.0; set rmargin at screen 880 / 900.0
set title "below the shark" font ",12" offset 0,-0.6
set xlabel "ns a shaded texel"
set xrange [10:100000]; set yrange [1:100]
set xtics ("10" 10, "100" 100, "1000" 1000, "10 000" 1e4)
set ytics ("1 %%" 1, "2 %%" 2, "5 %%" 5, "10 %%" 10, "20 %%" 20, "50 %%" 50, "100 %%" 100)
plot ground("differential rendering, [0-9]+ lights") using 1:2 with linespoints pointtype 4 linecolor rgb '#0072B2' title 'differential rendering', \
    ground("[*][*]film shadows") using 1:2 with points pointtype 15 pointsize 1.3 linecolor rgb '#E69F00' title 'film shadows (the game)'
unset multiplot
unset output
