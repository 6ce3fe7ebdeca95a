# contact.tsv as tables: all means, weighted by the number of values.
function put(scene, measure, speed, rate) { # adds the row to the cell of its scene, or to one of all speeds or rates
    key = $1 SUBSEP scene SUBSEP measure SUBSEP speed SUBSEP rate
    sum[key] += $6 * $7; count[key] += $7
}
function mean(method, scene, measure, speed, rate) {
    key = method SUBSEP scene SUBSEP measure SUBSEP speed SUBSEP rate
    return count[key] ? sum[key] / count[key] : -1
}
function short(value) { return value < 0 ? "" : value == 0 ? "0" : value < 0.001 ? "<0.001" : sprintf(value < 0.995 ? "%.2g" : value < 100 ? "%.1f" : "%.0f", value) }
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
    ours = names[1]; bullet = "capsules, 16 steps"; moved = "Shoal, moved at once"
    printf "Ours finds every first touch, %s ms off in the mean, and no fish passes through a bone. Bullet's capsules let %s %% of the struck fish through in one step a tick, ", \
        short(mean(ours, "strike", "first touch, ms", "", "")), short(mean("capsules, 1 step", "strike", "passed through, %", "", ""))
    printf "%s %% in four and %s %% in sixteen, which are %s ms off and cost %s times ours. ", short(mean("capsules, 4 steps", "strike", "passed through, %", "", "")), \
        short(mean(bullet, "strike", "passed through, %", "", "")), short(mean(bullet, "strike", "first touch, ms", "", "")), short(mean(bullet, "forty fish", "cost, times ours", "", ""))
    printf "Bullet is better at one thing: a struck fish of ours goes on only in the next tick, and ends %s mm off its place in the mean of all speeds, %s mm by Bullet's sixteen steps; at 20 m/s that is behind the bone, though with its speed. ", \
        short(mean(ours, "strike", "off its place, mm", "", "")), short(mean(bullet, "strike", "off its place, mm", "", ""))
    printf "If it went on at once, from the time of first touch, it would be %s mm. Ours finds near pairs by Bullet's tree of boxes; with every pair tried it would cost %s times as much.\n\n", \
        short(mean(moved, "strike", "off its place, mm", "", "")), short(mean("Shoal, every pair", "forty fish", "cost, times ours", "", ""))
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
    print "\nBones have a radius of 8 mm, fish are clownfish: capsules of 24 mm around 60 mm, or the ellipsoid inside with the same bounds. 40 scenes"
    print "of each kind at any place and in any direction, the same for all methods; means. First touch, direction and depth are compared with"
    print "closed forms in double precision for capsules, with a curve beside an ellipse for ellipsoids, and across an axis with the least overlap of"
    print "the shapes; depth is that at the report, where the shapes still overlap. A place is off by what lies between the fish and where the"
    print "bone would have taken it; fish that are passed through do not count, which flatters few steps. Passed through: left behind with less"
    print "than half of the speed that the bone gives. Speed gained: of the fish beyond the bone's (a flung fish's own; held: the fastest"
    print "moment). Flips: normals that turn by more than 90 degrees between two ticks of one contact. Spat out: no longer between the bones,"
    print "which stop 16 mm deep in both sides; an ellipsoid held off its middle slides out like a pip, for there is no friction. Continuous"
    print "collision sweeps what moves by itself, so it helps flung fish, by a sphere at their middle, and not those that a bone strikes."
    print "\nBullet 3.24, single precision, scalar rows, 10 iterations (as ours), neither warm starting nor random order, no friction, fish do not"
    print "turn; its own steps are told of the bones' places between ticks. It counts in centimetres, because its constants want bodies of 0.05"
    print "to 10 units. In metres GJK stops a centimetre too early, and overlaps burst, as the two rows show."
    print "\nMoving twelve loose bodies that sink to a level floor or drift among forty fish takes " \
        short(mean("Shoal", "loose", "us a tick", "", "")) " us a tick besides."
    print "\nShoal, every pair: all fish against all bones. Shoal, moved at once: not in the game. Cost: medians of 15 rounds of 240 ticks at 120 a second,"
    print "methods in turn, ratios to ours of the same round."
}
