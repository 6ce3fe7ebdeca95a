# Draws the chart: gnuplot -c occlusion.gp FOLDER, where bench_occlusion left occlusion.data.gp. Colours: Okabe and Ito
# 2008, "Color Universal Design"; shapes differ as well.
folder = ARG1
load folder . "/occlusion.data.gp"
colours = "#000000 #D55E00 #0072B2 #009E73 #56B4E9 #CC79A7 #E69F00 #000000 #D55E00 #0072B2"
shapes = "3 7 5 9 13 11 15 1 6 4"
set terminal svg size 900,1180 font "DejaVu Sans,12" background "white"
set output folder . "/occlusion.svg"
set multiplot
set logscale xy
set xrange [20:4e6]; set yrange [0.6:110]
set xtics () font ",11"; set ytics () font ",11"
do for [decade = 0:6] {
    set xtics add (sprintf("%g", 10.0 ** decade) 10.0 ** decade)
    do for [step in "1 2 5"] { set ytics add (sprintf("%g %%%%", int(step) * 10.0 ** decade / 10) int(step) * 10.0 ** decade / 10) }
}
set grid xtics ytics linecolor rgb "#d0d0d0" linewidth 0.7
set tics scale 0.6
set border linecolor rgb "#606060"
set lmargin at screen 0.09; set rmargin at screen 0.985
set ylabel "error of diffuse light (relative root mean square)" offset 1.6
set xlabel "nanoseconds a shaded point, one core"
do for [panel = 1:2] {
    top = 1 - 0.50 * (panel - 1)
    set tmargin at screen top - 0.105; set bmargin at screen top - 0.45
    set label 1 value(sprintf("title%d", panel)) at screen 0.53,top - 0.012 center font ",15"
    set key at screen 0.53,top - 0.062 center center horizontal maxrows 4 samplen 0.5 width -4 font ",10"
    set arrow 1 from graph 0,first 5 to graph 1,first 5 nohead dashtype 3 linewidth 1.6 linecolor rgb "#606060"
    draw = "plot "
    do for [i = 1:words(families)] {
        draw = draw . sprintf("$points%d_%d using 1:2 with points pointtype %s pointsize 1.1 linecolor rgb '%s' title '%s', ", panel, i, word(shapes, i), word(colours, i), word(families, i))
    }
    draw = draw . sprintf("$labels%d using 1:2:3 with labels left offset 0.9,0 font ',9' notitle", panel)
    eval draw
    unset label 1
}
unset multiplot
unset output
