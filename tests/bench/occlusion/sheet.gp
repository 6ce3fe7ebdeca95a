# Writes names over and beside occlusion_sheet.png: gnuplot -c sheet.gp FOLDER.
folder = ARG1
columns = "off|thesis: 150 views of 64|cured: 150 views of 64|ellipsoids and baked|truth"
rows = "teapot-like, mirror|bunny-like|torus, mirror|fish|hand closing on a fish|shark above a shoal"
part(list, n) = n == 1 || strstrt(list, "|") == 0 ? list[1:(strstrt(list, "|") == 0 ? strlen(list) : strstrt(list, "|") - 1)] : part(list[strstrt(list, "|") + 1:*], n - 1)
set terminal jpeg size 1216,1116 font "DejaVu Sans,11"
set output folder . "/occlusion_sheet.jpg"
set lmargin at screen 16.0 / 1216; set rmargin at screen 1
set bmargin at screen 0; set tmargin at screen 1 - 36.0 / 1116
unset xtics; unset ytics; unset border; unset key
set xrange [0:1200]; set yrange [1080:0]
do for [i = 1:5] { set label i part(columns, i) at screen (16 + 240 * (i - 0.5)) / 1216,1 - 18.0 / 1116 center }
do for [i = 1:6] { set label 10 + i part(rows, i) at screen 8.0 / 1216,1 - (36 + 180 * (i - 0.5)) / 1116 center rotate by 90 }
plot folder . "/occlusion_sheet.png" binary filetype=png flipy origin=(0.5,0.5) with rgbimage
