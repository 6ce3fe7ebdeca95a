// bench_chart FOLDER [--quick]: measures, writes tables and what the picture is drawn from. tests/bench/chart
// builds it, starts it and draws.
#include "tests/bench/light/Measure.h"

int main(int argc, char** argv) {
    using namespace shoal;
    if (bench::lacksArguments(argc, 1, "bench_chart FOLDER [--quick]")) return 2;
    const Path folder = argv[1];
    bench::Chart chart = bench::measure(argc == 3);
    Status done = bench::lightBalls(folder / "balls.jpg").moveTo(chart.balls);
    for (const auto write : {bench::writeMarkdown, bench::writePicture})
        if (done) done = write(chart, folder);
    return bench::exitStatus("chart", done);
}
