# caustics.tsv as a table.
NR == 1 {
    print ""
    print "The sun's light, which waves focus, on animals of 20 cm over a second, by what the film's ground shows where the light's ray meets it:"
    print ""
    print "| film | places | error without, % | with, % | change in truth, % | found, % | us a place |"
    print "|---|--:|--:|--:|--:|--:|--:|"
    next
}
{ printf "| %s | %d | %s | %s | %s | %s | %s |\n", $1, $2, $3, $4, $3, $5, $6 }
END {
    print ""
    print "Root mean square about the mean of each place's second, in percent of what a level sea lets through. Without, the change in truth is the error."
}
