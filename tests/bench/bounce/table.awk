# bounce.tsv as a table: of all grids and bounds the ones worth a row.
NR == 1 { next }
{
    if ($1 != film || $2 != light) {
        film = $1; light = $2
        if (NR > 2) print ""
        printf "%s, %s: %d places, %d within 1 m of rock, %d within 2 m\n\n", film, light, $6, $9, $12
        print "| light at a place | texels around | endless from, m | all, % | | within 1 m | | within 2 m | | beyond | | us a place |"
        print "|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|"
    }
    printf "| %s | %s | %s | %.1f | %.1f | %.1f | %.1f | %.1f | %.1f | %.1f | %.1f | %s |\n", $3, ($4 ? $4 : ""), ($5 ? $5 : ""), $7, $8, $10, $11, $13, $14, $16, $17, ($18 > 0 ? sprintf("%.1f", $18) : "")
}
END {
    print ""
    print "Error of diffuse light: root mean square over all directions, relative to the true; of each group of places the median and the 90th percentile."
}
