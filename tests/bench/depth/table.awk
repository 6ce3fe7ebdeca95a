# depth.tsv as a table.
NR == 1 { next }
NR == 2 {
    print "| | around | every | steps an octave | map | a minute of reef, night, kelp, MB | decoding, ms | map, ms | fish wrongly hidden, % | wrongly shown, % | anywhere, % | edges, texels | flicker, texels |"
    print "|---|--:|--:|--:|--:|---|--:|--:|--:|--:|--:|--:|--:|"
}
{
    steps = $4 == 1024 ? "all" : $4
    if ($1 == "no occlusion") {
        printf "| no occlusion | | | | | | | | %.1f | %.1f | %.2f | %.2f | 0 |\n", $11, $12, $13 + $14, $15
        next
    }
    name = $2 == 256 && $3 == 2 && $4 == 16 && $5 == 1024 && $1 == "refined" ? "**refined**" : $1
    printf "| %s | %d | %d | %s | %d | %.1f, %.1f, %.1f | %.1f | %.1f | %.1f | %.1f | %.2f | %.2f | %.2f |\n", name, $2, $3, steps, $5, $6, $7, $8, $9, $10, $11, $12, $13 + $14, $15, $16
    change = $17
}
END {
    print ""
    print "Edges: mean width of what is wrongly hidden or shown along the true edges, in texels of 2048 around. Flicker: what changes from one"
    printf "frame to the next where the truth does not, in the same unit; the truth itself changes by %.2f. Times are the processor's.\n", change
}
