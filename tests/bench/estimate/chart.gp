# Draws the chart: gnuplot -c chart.gp FOLDER, where depth_estimate.tsv is. Colours: Okabe and Ito 2008.
rows(film) = sprintf("< awk -F'\\t' '$1 == \"%s\" && NF == 8' '%s/depth_estimate.tsv'", film, ARG1)
set terminal svg size 900,1250 font "DejaVu Sans,11" background "white"
set output ARG1 . "/depth_estimate.svg"
set datafile separator "\t"
set grid linecolor rgb "#d0d0d0" linewidth 0.7
set border linecolor rgb "#606060"
set tics scale 0.6
set yrange [0:100]
set key off
films = "reef reef_20s reef_40s night night_20s kelp kelp_20s sideways forward caustics animal featureless exposure seam_poles stereo"
set multiplot layout 5,3 title "Thick: of confident texels within 10 % of the truth, %; thin: of what is nearer than 10 m confident, %; over seconds" font ",12"
do for [film in films] {
    set title film noenhanced
    set xrange [0:(film[1:4] eq "reef" || film[1:5] eq "night" || film[1:4] eq "kelp" ? 4 : 2)]
    colour = film eq "stereo" ? 0x009E73 : 0x0072B2
    plot rows(film) using 2:(100 * $3) with lines linewidth 2.5 linecolor rgb colour, \
        rows(film) using 2:(100 * $5) with lines linewidth 1 linecolor rgb colour
}
unset multiplot
