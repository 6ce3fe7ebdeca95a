# depth_estimate.tsv as a table.
NR == 1 { next }
!($1 in frames) { order[++count] = $1 }
$2 == "cannot be known" { frames[$1] = 0; next }
{
    if (!frames[$1]) { least[$1] = $6; most[$1] = $6; worst[$1] = $3 }
    ++frames[$1]
    right[$1] += $3; own[$1] += $4; covered[$1] += $5
    if ($6 < least[$1]) least[$1] = $6
    if ($6 > most[$1]) most[$1] = $6
    if ($3 < worst[$1]) worst[$1] = $3
    factor[$1] = $7; time[$1] = $8
}
END {
    print "| film | within 10 %, % | worst frame | each frame scaled, % | of what is nearer than 10 m, % | scale over time | scale guessed | processor, s a frame |"
    print "|---|--:|--:|--:|--:|--:|--:|--:|"
    for (i = 1; i <= count; ++i) {
        key = order[i]
        n = frames[key]
        if (!n) {
            printf "| %s | says that it cannot be known | | | | | | |\n", key
            continue
        }
        printf "| %s | %.0f | %.0f | %.0f | %.0f | %.2f to %.2f | %.2f | %.2f |\n", key, 100 * right[key] / n, 100 * worst[key],
            100 * own[key] / n, 100 * covered[key] / n, least[key], most[key], factor[key], time[key]
    }
    print ""
    print "Within 10 %: share of the confident solid angle (confidence of 0.6 and more) whose distance is within 10 % of the true one after one"
    print "factor for the film, because the scale of a film of one eye cannot be seen; each frame scaled: after a factor of the frame's own. Scale"
    print "guessed: that factor, the median of estimated over true distances; stereo has its scale from the eyes. Scale over time: the least and"
    print "the greatest of the frames' own factors over the film's. Means of all frames; times are the processor's, of both cores together, and"
    print "per frame of the track, which is every second of the film."
}
