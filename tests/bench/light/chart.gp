# Draws the chart: gnuplot -c chart.gp FOLDER, where bench_chart left chart.data.gp. Colours: Okabe and Ito
# 2008, "Color Universal Design"; shapes differ as well.
folder = ARG1
load folder . "/chart.data.gp"

width = 900.0; height = 1180.0
colours = "#D55E00 #0072B2 #009E73 #56B4E9 #CC79A7 #E69F00 #000000"
shapes = "5 7 5 4 9 13 11"
colour(i) = word(colours, i)
shape(i) = int(word(shapes, i))

do for [kind in "svg png"] {
    if (kind eq "svg") {
        set terminal svg size width,height font "DejaVu Sans,12" background "white"
    } else {
        # Twice the size: sharp where 900 pixels show it.
        set terminal pngcairo size 2 * width,2 * height font "DejaVu Sans,12" fontscale 2 linewidth 2 pointscale 2 background "white"
    }
    set output folder . "/chart." . kind
    set multiplot
    set logscale xy
    set grid xtics ytics mxtics mytics linecolor rgb "#d8d8d8" linewidth 0.6, linecolor rgb "#eeeeee" linewidth 0.4
    set tics scale 0.6
    set border linecolor rgb "#606060"
    set lmargin at screen 72 / width; set rmargin at screen (72 + 810) / width
    set format y "%g %%"
    set ylabel "error, relative RMS" offset 1
    set format x "%g"

    do for [panel in "diffuse glossy"] {
        top = panel eq "diffuse" ? 80.0 : 680.0
        set tmargin at screen 1 - top / height; set bmargin at screen 1 - (top + 430) / height
        set key at screen 0.5,1 - (top - 36) / height center center horizontal maxrows 2 samplen 1 width 1 font ",11"
        if (panel eq "diffuse") {
            set title "Diffuse light: speed against accuracy" font ",15" offset 0,2.6
            set xlabel sprintf("microseconds for a 2048x1024 video frame, one core (a plain read of its bytes: %.0f, the pyramid, counted in: %.0f)", read_us, pyramid_us)
        } else {
            set title "Glossy light, roughness 0.1 to 1" font ",15" offset 0,2.6
            set xlabel "microseconds for a 2048x1024 video frame and 100 000 shaded pixels, one core"
        }
        eval sprintf("set xrange [%s_left:%s_right]; set yrange [%s_low:%s_high]; families = %s_families", panel, panel, panel, panel, panel)
        draw = "plot $P_front using 1:2 with steps linecolor rgb '#909090' linewidth 2 title 'the front', "
        draw = draw . "$P_led using 1:2:($3-$1):($4-$2) with vectors nohead linecolor rgb '#b0b0b0' linewidth 0.7 notitle, "
        do for [i = 1:words(families)] {
            draw = draw . (i == 1 ? sprintf("$P_family1 using 1:2:('★') with labels font ',24' textcolor rgb '%s' notitle, NaN with points pointtype '★' linecolor rgb '%s' title '%s', ", colour(1), colour(1), word(families, 1)) \
                                  : sprintf("$P_family%d using 1:2 with points pointtype %d pointsize 1.1 linecolor rgb '%s' title '%s', ", i, shape(i), colour(i), word(families, i)))
        }
        draw = draw . "$P_thesis using 1:2 with points pointtype 6 pointsize 2.2 linewidth 1.4 linecolor rgb '#000000' title 'the thesis', "
        draw = draw . "$P_all using 3:4:5 with labels center font ',10' notitle"
        # gnuplot has no function for this: put the panel's name for P.
        while (strstrt(draw, "$P_") > 0) {
            at = strstrt(draw, "$P_")
            draw = draw[1:at] . panel . draw[at + 2:*]
        }
        eval draw
    }
    unset multiplot
    unset output
}
