# film.tsv as a table; decoding and detail in units of the first film's.
NR == 1 { next }
{ row[NR] = $0; if ($1 == "first") { base = $5; sharp = $9 } }
END {
    print "| codec | around | quality | a minute, MB | decoding | conversion | error, linear, % | luma, dB | detail, cycles around | blocks |"
    print "|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|"
    for (i = 2; i <= NR; ++i) {
        split(row[i], f, "\t")
        printf "| %s | %d | %s | %.1f | %.2f | %.2f | %.1f | %.1f | %d (%.2f) | %.2f |\n", f[1] == "first" ? "**H.264, the first film**" : f[1], f[2], f[3] ? f[3] : "", f[4], f[5] / base, f[6] / base, f[7], f[8], f[9], f[9] / sharp, f[10]
    }
}
