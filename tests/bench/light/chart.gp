# Draws the chart: gnuplot -c chart.gp FOLDER, where bench_chart left chart.data.gp. Colours: Okabe and Ito
# 2008, "Color Universal Design"; shapes differ as well.
folder = ARG1
load folder . "/chart.data.gp"

width = 900.0; panel_height = 615.0
plot_left = 84.0; plot_width = 790.0; plot_height = 430.0 # Picture.cpp has the same
colours = "#D55E00 #0072B2 #009E73 #56B4E9 #CC79A7 #E69F00 #000000"
shapes = "5 7 5 4 9 13 11"

# The star is a letter; other shapes are gnuplot's.
points(family, style, name) = style == 1 \
    ? sprintf("$P_family%d using 1:2:('★') with labels font ',24' textcolor rgb '%s' notitle, keyentry with points pointtype '★' linecolor rgb '%s' title '%s', ", family, word(colours, 1), word(colours, 1), name) \
    : sprintf("$P_family%d using 1:2 with points pointtype %s pointsize 1.1 linecolor rgb '%s' title '%s', ", family, word(shapes, style), word(colours, style), name)
replaced(text, at, what) = text[1:at - 1] . what . text[at + 1:*]

do for [picture in "chart suns"] {
    panels = picture eq "chart" ? "diffuse glossy" : "suns"
    height = panel_height * words(panels)
    set terminal svg size width,height font "DejaVu Sans,12" background "white"
    set output folder . "/" . picture . ".svg"
    set multiplot
    set logscale xy
    set xtics () font ",11"
    set ytics () font ",11"
    do for [decade = -3:7] {
        do for [step in "1 2 5"] {
            tic = int(step) * 10.0 ** decade
            set xtics add (sprintf(tic < 10000 ? "%g" : "%.0f 000", tic < 10000 ? tic : tic / 1000) tic)
            set ytics add (sprintf("%g %%%%", tic) tic)
        }
    }
    set grid xtics ytics linecolor rgb "#d0d0d0" linewidth 0.7
    set tics scale 0.6
    set border linecolor rgb "#606060"
    set lmargin at screen plot_left / width; set rmargin at screen (plot_left + plot_width) / width
    set ylabel "error (relative root mean square)" offset 1.6

    do for [n = 1:words(panels)] {
        panel = word(panels, n)
        top = panel_height * (n - 1) + 112
        set tmargin at screen 1 - top / height; set bmargin at screen 1 - (top + plot_height) / height
        set key at screen 0.53,1 - (top - 42) / height center center horizontal maxrows 2 samplen 1 width 0 font ",11"
        unset arrow; unset label
        if (panel eq "diffuse") {
            title = "Diffuse light"
            axis = sprintf("microseconds for a 2048x1024 video frame on one core, beyond its pyramid (%.0f; a plain read: %.0f)", pyramid_us, read_us)
        } else {
            title = "Glossy light, roughness 0.1 to 1, environments with" . (panel eq "suns" ? " a point sun" : "out point suns")
            axis = "microseconds for a 2048x1024 video frame and 100 000 shaded pixels on one core"
        }
        set label title at screen 0.53,1 - (top - 96) / height center font ",15"
        set xlabel axis
        eval sprintf("set xrange [%s_left:%s_right]; set yrange [%s_low:%s_high]; families = %s_families; styles = %s_styles", panel, panel, panel, panel, panel, panel)
        draw = "plot $P_front using 1:2 with steps linecolor rgb '#909090' linewidth 1.6 title 'nothing is faster and better', "
        if (value(panel . "_led_count") > 0) { draw = draw . "$P_led using 1:2:($3-$1):($4-$2) with vectors nohead linecolor rgb '#808080' linewidth 0.7 notitle, " }
        do for [i = 1:words(families)] { draw = draw . points(i, int(word(styles, i)), word(families, i)) }
        draw = draw . "$P_thesis using 1:2 with points pointtype 6 pointsize 2.2 linewidth 1.4 linecolor rgb '#000000' title 'the choice of the thesis', "
        draw = draw . "$P_all using 3:4:5 with labels center font ',10' notitle"
        # gnuplot has no function to replace text: P stands for the panel's name.
        while (strstrt(draw, "$P_") > 0) { draw = replaced(draw, strstrt(draw, "$P_") + 1, panel) }
        eval draw
    }
    unset multiplot
    unset output
}
