# Draws error over cost of the ways from coded values to radiance: gnuplot -c tonemaps.gp FOLDER, where bench_chart left
# tonemaps.dat. Colours: Okabe and Ito 2008, "Color Universal Design"; shapes differ as well.
folder = ARG1
data = folder . "/tonemaps.dat"
methods = int(system(sprintf("grep -c -v '^0.000 ' '%s'", data)))
all = int(system(sprintf("grep -c . '%s'", data)))
name(i) = system(sprintf("sed -n '%ds/.*\"\\(.*\\)\"/\\1/p' '%s'", i, data))
field(i, column) = real(word(system(sprintf("sed -n '%dp' '%s'", i, data)), column))
colours = "#D55E00 #0072B2 #009E73 #E69F00 #CC79A7 #56B4E9 #000000"
shapes = "5 7 9 11 13 4 6 8 10 12 2 14"
set terminal svg size 900,620 font "DejaVu Sans,12" background "white"
set output folder . "/tonemaps.svg"
set multiplot
set logscale x
set grid linecolor rgb "#d0d0d0" linewidth 0.7
set border linecolor rgb "#606060"
set xlabel "milliseconds for a 2048x1024 frame, one core" font ",11"
set xrange [*:*]; set xtics font ",11"; set ytics font ",11"
set offsets graph 0.05, graph 0.05, 0, 0
stats data using (column(2) > column(3) ? column(2) : column(3)) nooutput
set yrange [0:1.1 * STATS_max]; set format y "%g %%"
set tmargin at screen 0.93; set bmargin at screen 0.40
do for [film = 0:1] {
    set lmargin at screen 0.09 + 0.48 * film; set rmargin at screen 0.50 + 0.48 * film
    set title film ? "Our film" : "HDR pictures, clipped"
    set ylabel film ? "" : "error of diffuse light, median over pictures" font ",11"
    if (film) { unset key } else { set key at screen 0.5,0.29 center top maxrows 8 samplen 2 font ",10" }
    plot for [i = 1:methods] data every ::i-1::i-1 using 1:2+film with points pointtype int(word(shapes, i)) \
        pointsize 1.3 linecolor rgb word(colours, (i - 1) % 7 + 1) title name(i), \
        for [i = methods + 1:all] field(i, 2 + film) with lines linewidth 1.4 dashtype i - methods + 1 \
        linecolor rgb word(colours, (i - methods) % 7 + 1) title name(i)
}
unset multiplot
unset output
