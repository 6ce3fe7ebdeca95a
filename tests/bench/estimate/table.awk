# depth_estimate.tsv as a table.
NR == 1 { next }
!(($1 SUBSEP $2) in frames) { order[++count] = $1 SUBSEP $2 }
$3 == "cannot be known" { frames[$1 SUBSEP $2] = 0; next }
{
    key = $1 SUBSEP $2
    if (!frames[key]) { least[key] = $7; most[key] = $7; worst[key] = $4 }
    ++frames[key]
    right[key] += $4; own[key] += $5; covered[key] += $6
    if ($7 < least[key]) least[key] = $7
    if ($7 > most[key]) most[key] = $7
    if ($4 < worst[key]) worst[key] = $4
    factor[key] = $8; time[key] = $9
}
END {
    print "| film | method | within 10 %, % | worst frame | each frame scaled, % | of what is nearer than 10 m, % | scale over time | scale guessed | processor, s a frame |"
    print "|---|---|--:|--:|--:|--:|--:|--:|--:|"
    for (i = 1; i <= count; ++i) {
        key = order[i]
        split(key, part, SUBSEP)
        n = frames[key]
        if (!n) {
            printf "| %s | %s | says that it cannot be known | | | | | | |\n", part[1], part[2]
            continue
        }
        printf "| %s | %s | %.0f | %.0f | %.0f | %.0f | %.2f to %.2f | %.2f | %.2f |\n", part[1], part[2], 100 * right[key] / n, 100 * worst[key],
            100 * own[key] / n, 100 * covered[key] / n, least[key], most[key], factor[key], time[key]
    }
    print ""
    print "Within 10 %: share of the confident solid angle (confidence of 0.6 and more) whose distance is within 10 % of the true one after one"
    print "factor for the film, because the scale of a film of one eye cannot be seen; each frame scaled: after a factor of the frame's own. Scale"
    print "guessed: that factor, the median of estimated over true distances; stereo has its scale from the eyes. Scale over time: the least and"
    print "the greatest of the frames' own factors over the film's. Means of all frames; times are the processor's, of both cores together, and"
    print "per frame of the track, which is every second of the film."
}
