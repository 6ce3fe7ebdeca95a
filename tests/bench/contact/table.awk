# contact.tsv as tables: all means, weighted by the number of values.
function put(scene, measure, speed, rate) { # adds the row to the cell of its scene, or to one of all speeds or rates
    key = $1 SUBSEP scene SUBSEP measure SUBSEP speed SUBSEP rate
    sum[key] += $6 * $8; count[key] += $8
    if ($7 > worst[key]) worst[key] = $7
}
function mean(method, scene, measure, speed, rate) {
    key = method SUBSEP scene SUBSEP measure SUBSEP speed SUBSEP rate
    return count[key] ? sum[key] / count[key] : -1
}
function short(value) { return value < 0 ? "" : value == 0 ? "0" : value < 0.001 ? "<0.001" : sprintf(value < 1 ? "%.2g" : value < 100 ? "%.1f" : "%.0f", value) }
function cell(scene, measure) { return " | " short(mean(method, scene, measure, "", "")) }
NR == 1 { next }
{
    if (!($1 in known)) { known[$1]; names[++methods] = $1 }
    put($2, $5, "", ""); put($2, $5, $3, $4)
}
function bySpeed(title, scene, measure, speeds, n, i, j, m) {
    n = split(speeds, of, " ")
    printf "\n%s\n\n| bone, m/s", title
    for (i = 1; i <= n; ++i) printf " | %s | | ", of[i]
    printf " |\n|---"
    for (i = 1; i <= 3 * n; ++i) printf "|--:"
    printf "|\n| ticks a second"
    for (i = 1; i <= n; ++i) printf " | 60 | 120 | 240"
    print " |"
    for (m = 1; m <= methods; ++m) {
        if (names[m] ~ /every pair/) continue
        printf "| %s", names[m]
        for (i = 1; i <= n; ++i) for (j = 60; j <= 240; j *= 2) printf " | %s", short(mean(names[m], scene, measure, of[i], j))
        print " |"
    }
}
END {
    print "A bone strikes the side of a fish, at 0.1 to 20 m/s and 60 to 240 ticks a second (the tables below have each):\n"
    print "| contacts by | cost, of ours | first touch, ms off | direction, degrees off | depth, mm off | fish off its place, mm | speed gained, % | passed through, % | flung fish passed through, % |"
    print "|---|--:|--:|--:|--:|--:|--:|--:|--:|"
    for (m = 1; m <= methods; ++m) {
        method = names[m]
        print "| " method cell("forty fish", "cost, times ours") cell("strike", "first touch, ms") cell("strike", "direction, degrees") \
            cell("strike", "depth, mm") cell("strike", "off its place, mm") cell("strike", "speed gained, %") cell("strike", "passed through, %") \
            cell("flung", "passed through, %") " |"
    }
    print "\nA bone that already lies across a fish's axis or up to 5 mm beside it, a fish that two bones close on and hold, and forty fish with two fists:\n"
    print "| contacts by | across: degrees off | speed left, m/s | beside: degrees off | speed left, m/s | held: spat out, % | speed gained, % | flips, of 1000 | forty fish: flips, of 1000 | contacts a tick | us a tick |"
    print "|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|"
    for (m = 1; m <= methods; ++m) {
        method = names[m]
        print "| " method cell("crossed", "direction, degrees") cell("crossed", "speed left, m/s") cell("nearly crossed", "direction, degrees") \
            cell("nearly crossed", "speed left, m/s") cell("squeezed", "spat out, %") cell("squeezed", "speed gained, %") \
            cell("squeezed", "flips, of 1000") cell("forty fish", "flips, of 1000") cell("forty fish", "contacts a tick") \
            cell("forty fish", "us a tick") " |"
    }
    bySpeed("Strikes that pass through, %:", "strike", "passed through, %", "0.1 1 5 20")
    bySpeed("First touch, ms off (of those that are found):", "strike", "first touch, ms", "0.1 1 5 20")
    bySpeed("Fish off its place at the end, mm (of those that are not passed through):", "strike", "off its place, mm", "0.1 1 5 20")
    bySpeed("Speed gained in strikes, %:", "strike", "speed gained, %", "0.1 1 5 20")
    bySpeed("Held fish that are spat out, %:", "squeezed", "spat out, %", "0.1 0.5 2")
}
