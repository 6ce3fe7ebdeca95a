// The program as a person meets it: bad input gets one sentence on standard error and a non-zero exit, never
// a crash, and nothing half written; scripts and replays end with the status that they promise.
#include "Program.h"
#include "tests/playthrough/Play.h"
#include "tests/unit/media/TestFiles.h"

#include <fmt/core.h>

namespace shoal {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using tests::Outcome;

// Returns a repeating grey ramp as a PNM file.
std::string pnm(int width, int height, const char* kind = "P5") {
    std::string bytes = fmt::format("{} {} {} 255\n", kind, width, height);
    const int channels = kind[1] == '6' ? 3 : 1;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width * channels; ++x) bytes += static_cast<char>((x / channels + y) % 200 + 20);
    return bytes;
}

class Program : public tests::Program {
  protected:
    const std::string angelfish_ = tests::sourceFolder() / "content/models/angelfish.glb";
    const std::string play_ = "play --headless --at 0.1 --size 64x36 "; // the shortest

    // Draws a model before a photo, to out.png.
    Outcome view(const std::string& model, const std::string& options) const {
        return run("view " + model + " --photo " + write("photo.ppm", pnm(256, 128, "P6")) +
                   " --out out.png " + options);
    }

    // Files that `light` makes of photo.ppm and writes to the folder `out`, by name.
    std::map<std::string, std::string> lightFiles(const std::string& out, const std::string& how) const {
        const Outcome made = run("light photo.ppm -o " + out + " " + how);
        if (made.status != 0) throw std::runtime_error(made.err);
        std::map<std::string, std::string> files;
        for (const auto& each : fs::directory_iterator(folder_ / out))
            files[each.path().filename().string()] = readText(each.path()).value();
        return files;
    }
};

// Loading the libraries would take a tenth of a second and an eighth of the memory (engine/media/Codecs.h).
TEST_F(Program, StartsWithoutTheLibrariesOfPicturesAndCameras) {
    environment_ = "LD_TRACE_LOADED_OBJECTS=1";
    const std::string libraries = run("").out;
    EXPECT_NE(libraries.find("opencv_core"), std::string::npos) << "else nothing is listed";
    for (const char* name : {"opencv_imgcodecs", "opencv_videoio", "gdal"})
        EXPECT_EQ(libraries.find(name), std::string::npos) << name;
}

TEST_F(Program, HelpNamesUnits) {
    const Outcome help = run("play --help");
    EXPECT_EQ(help.status, 0);
    for (const char* word : {"degrees", "seconds", "stops", "milli", "pixels"})
        EXPECT_NE(help.out.find(word), std::string::npos) << word;
}

TEST_F(Program, WrongWordsOnTheCommandLine) {
    expectOneMessage(run("play --size 12"), "--size", 2);
    expectOneMessage(run("play --fov 500"), "--fov", 2);
    expectOneMessage(run("play --xr --headless"), "--xr", 2);
    expectOneMessage(run("play --xr --stereo sbs"), "--xr", 2);
    expectOneMessage(run("play --headless --hands openxr"), "--xr");
    expectOneMessage(run("play --skin scales"), "--skin", 2);
    expectOneMessage(run("play --leap-mount knee"), "--leap-mount", 2);
    expectOneMessage(run("play --occlusion ollfb"), "--occlusion", 2); // of one body at rest: view has it
    expectOneMessage(run("view model.glb --diffuse none"), "--diffuse", 2);
    expectOneMessage(run("light photo.jpg -o out --method none"), "--method", 2);
    expectOneMessage(run("light photo.jpg -o out --diffuse-size 48"), "--diffuse-size", 2);
    expectOneMessage(run("view m.glb --diffuse thesis --diffuse-size 2048"), "--diffuse-size", 2);
}

TEST_F(Program, OptionsOfAMethodWantThatMethod) {
    const std::string view = "view m.glb --out a.png ";
    expectOneMessage(run(view + "--diffuse-size 32"), "--diffuse", 2);
    expectOneMessage(run(view + "--diffuse default --diffuse-size 32"),
                     "--diffuse-size: is for --diffuse thesis");
    expectOneMessage(run(view + "--ollfb-views 54"), "--occlusion", 2);
    expectOneMessage(run(view + "--occlusion off --ollfb-size 32"), "are for --occlusion ollfb");
    expectOneMessage(run(view + "--occlusion ollfb-thesis --ollfb-views 100"), "6 n^2 views");
}

TEST_F(Program, AMistypedWordIsMetWithTheOneThatMayBeMeant) {
    expectOneMessage(run("plya"), "there is no command plya; did you mean play?", 2);
    expectOneMessage(run("swim"), "there is no command swim (shoal --help", 2);
    expectOneMessage(run("play --sceenshot a.png"), "--sceenshot; did you mean --screenshot?", 2);
    expectOneMessage(run("--no-vsnyc"), "did you mean --no-vsync?", 2);
    expectOneMessage(run("view m.glb --variannt=b"), "--variannt; did you mean --variant?", 2);
    expectOneMessage(run("play --nonsense"), "--nonsense (shoal play --help", 2);
    expectOneMessage(run("play --headless --dive reeff"),
                     "reeff: there is no such dive; there is kelp, night, reef");
}

// A picture of another kind under a PNG's name, or a mistyped folder, is found before anything is played.
TEST_F(Program, AFileToBeWrittenMustHaveAPlace) {
    expectOneMessage(run(play_ + "--screenshot x.gif"), "x.gif");
    expectOneMessage(run(play_ + "--screenshot nowhere/out.png"), "nowhere");
    expectOneMessage(run(play_ + "--record nowhere/out.replay"), "nowhere");
    expectOneMessage(run(play_ + "--stats nowhere/out.json"), "nowhere");
    expectOneMessage(run("view m.glb --out x.gif"), "x.gif");
    expectOneMessage(run("view m.glb --out nowhere/out.png"), "nowhere");
    expectOneMessage(run("panorama p.jpg -o nowhere/out.png"), "nowhere");
    EXPECT_FALSE(fs::exists(folder_ / "nowhere"));
}

TEST_F(Program, DepthOfAStillCameraCannotBeKnown) {
    cv::Mat picture(128, 256, CV_8UC3);
    cv::RNG(3).fill(picture, cv::RNG::UNIFORM, 0, 255);
    media::writeFilm(
        folder_ / "still.avi", "MJPG", 12, [&](int) { return picture; }, 24);
    expectOneMessage(run("still.avi -o still.depth.mkv", depthProgram()), "cannot be known", 3);
    EXPECT_FALSE(fs::exists(folder_ / "still.depth.mkv"));
    EXPECT_FALSE(fs::exists(folder_ / "still.depth.mkv.part"));
}

// The output is checked before a frame is read: of two errors here, the message names the output.
TEST_F(Program, DepthIsMadeOfFilesAndHasToHaveAPlace) {
    write("film.mp4", "no film, but text");
    for (const auto& [arguments, about] :
         {std::pair("rtsp://localhost/live -o out.mkv", "depth is made of files"),
          {"camera:0 -o out.mkv", "depth is made of files"},
          {". -o out.mkv", "depth is made of files"},
          {"none.mp4 -o out.mkv", "none.mp4"},
          {"film.mp4 -o out.mkv", "film.mp4"},
          {"film.mp4 -o nowhere/out.mkv", "nowhere"},
          {"film.mp4 -o .", "it is a folder"},
          {"film.mp4 -o film.mp4", "film.mp4"},
          {"film.mp4 -o out.mkv --preview x.gif", "x.gif"}})
        expectOneMessage(run(arguments, depthProgram()), about);
    for (const char* name : {"nowhere", "out.mkv", "out.mkv.part"})
        EXPECT_FALSE(fs::exists(folder_ / name)) << name;
    EXPECT_EQ(textOf("film.mp4"), "no film, but text");
}

// A model without an occlusion file gets one, once, equal to the stored file of the same model.
TEST_F(Program, OcclusionOfAModelIsMadeOnceAndKept) {
    isFresh_ = true;
    fs::copy_file(angelfish_, folder_ / "copy.glb");
    const auto draw = [&](const std::string& model, const std::string& about = "") {
        const Outcome outcome = view(model, "--size 64x64");
        EXPECT_EQ(outcome.status, 0);
        EXPECT_NE(outcome.err.find(about), std::string::npos) << outcome.err;
        EXPECT_EQ(lines(outcome.err), about.empty() ? 0 : 1) << outcome.err;
        return tests::valueOf(readText(folder_ / "out.png"));
    };
    const std::string shaded = draw(angelfish_);
    write("shoal", "no folder"); // so that nothing can be kept
    EXPECT_NE(draw("copy.glb", "copy.glb: is shown without"), shaded);
    fs::remove(folder_ / "shoal");
    EXPECT_EQ(draw("copy.glb"), shaded);
    const fs::directory_iterator kept(folder_ / "shoal/occlusion");
    const auto made = fs::last_write_time(kept->path());
    EXPECT_EQ(draw("copy.glb"), shaded);
    EXPECT_EQ(fs::last_write_time(kept->path()), made);
}

// Each choice changes the picture, and its older name means the same.
TEST_F(Program, WaysOfLightingCanBeChosen) {
    const auto draw = [&](const std::string& options) {
        const Outcome outcome = view(angelfish_, "--size 64x64 " + options);
        EXPECT_EQ(outcome.status, 0) << options << outcome.err;
        return textOf("out.png");
    };
    const std::string ours = draw("");
    EXPECT_EQ(draw("--occlusion ellipsoids --diffuse default --glossy ggx"), ours);
    EXPECT_NE(draw("--occlusion off"), ours);
    EXPECT_NE(draw("--diffuse thesis"), ours);
    EXPECT_NE(draw("--glossy phong36"), ours);
    const std::string thesis = draw("--diffuse thesis");
    EXPECT_EQ(draw("--diffuse thesis --diffuse-size 64"), thesis);
    EXPECT_NE(draw("--diffuse thesis --diffuse-size 16"), thesis);
    const std::string akyuz = draw("--light akyuz");
    EXPECT_NE(akyuz, ours);
    EXPECT_NE(draw("--light landis"), akyuz);
}

// Below OpenGL 4.3 one sentence says so. If the driver cannot lower its version, a picture is drawn.
TEST_F(Program, LayersNeedANewerOpenGl) {
    setenv("MESA_GL_VERSION_OVERRIDE", "3.3", 1);
    const Outcome old = view(angelfish_, "--size 32x32 --occlusion ollfb"),
                  thesis = view(angelfish_, "--size 32x32 --occlusion ollfb-thesis");
    unsetenv("MESA_GL_VERSION_OVERRIDE");
    if (old.status == 0 && thesis.status == 0) GTEST_SKIP() << "this driver cannot be made old";
    expectOneMessage(old, "layers need OpenGL 4.3; this is 3.3");
    expectOneMessage(thesis, "layers need OpenGL 4.3; this is 3.3");
    EXPECT_FALSE(fs::exists(folder_ / "out.png"));
}

TEST_F(Program, LightByTheThesisHasTheSameFiles) {
    write("photo.ppm", pnm(256, 128, "P6"));
    const auto ours = lightFiles("default", "--method default --light thesis"),
               thesis = lightFiles("thesis", "--method thesis");
    ASSERT_GT(ours.size(), 3u);
    ASSERT_EQ(ours.size(), thesis.size());
    for (const auto& [name, bytes] : ours) {
        ASSERT_TRUE(thesis.contains(name)) << name;
        EXPECT_EQ(thesis.at(name).size(), bytes.size()) << name;
    }
    EXPECT_EQ(ours.at("sh.json"), thesis.at("sh.json"));
    EXPECT_NE(ours.at("diffuse.pfm"), thesis.at("diffuse.pfm"));
    EXPECT_NE(ours.at("glossy_1.00.pfm"), thesis.at("glossy_1.00.pfm"));
}

// Grey all around, of sRGB 188: each map is that, in its size; a sum over 16 x 8 texels is a little off.
TEST_F(Program, LightHasTheMapsThatAreAskedFor) {
    write("photo.ppm", "P6 256 128 255\n" + std::string(256 * 128 * 3, '\xbc'));
    for (const std::string method : {"default", "thesis"})
        for (const int width : {16, 64, 256}) {
            const auto files = lightFiles(method + std::to_string(width),
                                          "--light linear --roughness 0.5,0.01,0.055 --diffuse-size " +
                                              std::to_string(width) + " --method " + method);
            ASSERT_EQ(files.size(), 5u);
            for (const char* name :
                 {"diffuse.pfm", "glossy_0.01.pfm", "glossy_0.055.pfm", "glossy_0.5.pfm"}) {
                const std::string& bytes = files.at(name);
                if (name[0] == 'd') {
                    EXPECT_TRUE(bytes.starts_with(fmt::format("PF\n{} {}\n", width, width / 2))) << width;
                }
                std::vector<float> texels(name[0] == 'd' ? width * width / 2 * 3 : 64 * 32 * 3);
                const size_t size = texels.size() * sizeof(float);
                std::memcpy(texels.data(), bytes.data() + bytes.size() - size, size);
                for (const float texel : texels)
                    ASSERT_NEAR(texel, 0.5029, 0.0041 * 256 / (width * width) + 2e-4) << name << width;
            }
        }
}

// White above, dark grey below: auto alone estimates clipped light, and the thesis' operator scales all.
TEST_F(Program, LightOfCodedValuesAsAsked) {
    write("photo.ppm",
          "P6 256 128 255\n" + std::string(256 * 64 * 3, '\xff') + std::string(256 * 64 * 3, '\x40'));
    const auto of = [&](const std::string& how) {
        return lightFiles(how, "--light " + how).at("diffuse.pfm");
    };
    const std::string automatic = of("auto"), thesis = of("thesis"), linear = of("linear");
    EXPECT_EQ(lightFiles("unsaid", "").at("diffuse.pfm"), automatic);
    EXPECT_NE(automatic, linear);
    EXPECT_NE(automatic, thesis);
    EXPECT_NE(thesis, linear);
    EXPECT_NE(of("akyuz"), of("landis"));
    EXPECT_NE(of("landis"), linear);
    EXPECT_EQ(run("light photo.ppm -o none --light ours").status, 2);
}

TEST_F(Program, CheckSaysThatNothingOfAModelWillBeSeen) {
    const auto triangle = [&](const std::string& material) {
        return write(
            "triangle.gltf",
            R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,)"
            "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"
            R"("}],"bufferViews":[{"buffer":0,"byteLength":36}],)"
            R"("accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}],)"
            R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"material":0}]}],"nodes":[{"mesh":0}],)"
            R"("scenes":[{"nodes":[0]}],"scene":0,"materials":[)" +
                material + "]}");
    };
    const auto said = [&](const std::string& material) { return run("check " + triangle(material)).out; };
    const std::string clear = R"("pbrMetallicRoughness":{"baseColorFactor":[1,1,1,0]})";
    EXPECT_THAT(said(R"({"alphaMode":"BLEND",)" + clear + "}"), HasSubstr("wholly transparent"));
    EXPECT_THAT(said(R"({"alphaMode":"MASK",)" + clear + "}"), HasSubstr("wholly transparent"));
    EXPECT_THAT(said("{" + clear + "}"),
                AllOf(HasSubstr("a model of 1 triangle"), Not(HasSubstr("transparent"))));
}

TEST_F(Program, LayersOfWhatHasNoneAreRefused) {
    write("photo.ppm", "P6\n2 1\n255\n" + std::string(6, 'x'));
    write("species.toml", *readText(dataRoot() / "content/species.toml"));
    for (const std::string words : {"check photo.ppm", "check camera:0", "play --headless --video photo.ppm",
                                    "play --headless --photo photo.ppm", "panorama photo.ppm -o out.png",
                                    "light photo.ppm -o out", "check species.toml"})
        expectOneMessage(run(words + " --layer a"), "has no layers; leave --layer out", 1);
}

TEST_F(Program, HeadlessIsAcceptedByEveryCommand) {
    for (const char* command : {"play", "view", "light", "panorama", "check", "devices"})
        EXPECT_NE(run(std::string(command) + " --help").out.find("--headless"), std::string::npos) << command;
    EXPECT_EQ(run("check --headless " + (dataRoot() / "content/species.toml").string()).status, 0);
    expectOneMessage(run("view --headless model.glb"), "--out", 2);
}

TEST_F(Program, HeadlessRunsDoNotDependOnThePlayersSettings) {
    fs::create_directories(folder_ / "shoal");
    write("shoal/settings.json", "broken");
    EXPECT_NE(run("play").err.find("settings.json"), std::string::npos);
    EXPECT_THAT(run("play --headless --mute --size 64x64 --at 0.1").err, Not(HasSubstr("settings.json")));
}

TEST_F(Program, ABrokenScoresFileIsSaidOnce) {
    fs::create_directories(folder_ / "shoal");
    write("shoal/scores.json", "broken");
    const std::string err = run("play --headless --mute --size 64x64 --at 0.1 --screenshot a.png").err;
    const size_t first = err.find("scores.json");
    ASSERT_NE(first, std::string::npos);
    EXPECT_EQ(err.find("scores.json", first + 1), std::string::npos) << err;
}

TEST_F(Program, WithoutADisplayItSaysHowToSeeSomething) { expectOneMessage(run("play"), "--headless"); }

// A start from a menu has a display and no terminal. A fake of the message boxes' program records texts.
TEST_F(Program, StartedFromAMenuItTellsItsErrorsInAMessageBox) {
    const Path box = folder_ / "box.txt";
    write("zenity", "#!/bin/sh\nprintf '%s\\n' \"$@\" >" + box.string());
    fs::permissions(folder_ / "zenity", fs::perms::owner_all);
    const auto shown = [&](const std::string& arguments, int status) {
        fs::remove(box);
        const std::string command = "env PATH=" + folder_.string() +
                                    ":/usr/bin:/bin DISPLAY=:none XDG_CONFIG_HOME=" + folder_.string() +
                                    " setsid -w '" + tests::program() + "' " + arguments +
                                    " </dev/null >/dev/null 2>&1";
        EXPECT_EQ(WEXITSTATUS(std::system(command.c_str())), status) << arguments;
        return textOf("box.txt");
    };
    const std::string error = shown("play --hands feet", 1);
    EXPECT_NE(error.find("--error\n"), std::string::npos) << error;
    EXPECT_NE(error.find("--text=Shoal had to stop: --hands feet"), std::string::npos) << error;
    EXPECT_NE(shown("play '--dive=a\\nb'", 1).find("a\\\\nb: there is no such dive"), std::string::npos);
    EXPECT_NE(shown("plya", 2).find("did you mean play?"), std::string::npos);
    EXPECT_EQ(shown("play --headless --dive none", 1), "") << "nobody is there to close it";
    EXPECT_EQ(shown("check /nowhere/there.mp4", 1), "");
}

TEST_F(Program, EnvironmentsThatAreNone) {
    write("empty.mp4", "");
    write("text.mp4", "not a video");
    write("cut.jpg", "\xff\xd8\xff");
    fs::create_directory(folder_ / "films");
    expectOneMessage(run(play_ + "--video /nowhere/there.mp4"), "there.mp4");
    expectOneMessage(run(play_ + "--video empty.mp4"), "empty.mp4");
    expectOneMessage(run(play_ + "--video text.mp4"), "text.mp4");
    expectOneMessage(run(play_ + "--photo cut.jpg"), "cut.jpg");
    expectOneMessage(run(play_ + "--env cut.jpg"), "cut.jpg");
    expectOneMessage(run(play_ + "--video films"), "films");
    expectOneMessage(run(play_ + "/nowhere/there.mp4"), "there.mp4");
    expectOneMessage(run(play_ + "films"), "films");
    expectOneMessage(run(play_ + "cut.jpg --photo cut.jpg"), "--photo", 2);
}

// A desktop opens files by their content, whatever they are called.
TEST_F(Program, AFileAloneIsTheEnvironmentThatItHolds) {
    write("some photo.mp4", pnm(256, 128, "P6"));
    const std::string options = " --headless --at 0.1 --size 64x36 --screenshot ";
    ASSERT_EQ(run("play --photo 'some photo.mp4'" + options + "named.png").status, 0);
    const Outcome outcome = run("'some photo.mp4'" + options + "alone.png");
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(tests::valueOf(readText(folder_ / "alone.png")), textOf("named.png"));
}

TEST_F(Program, PanoramasThatCannotBe) {
    write("photo.pgm", pnm(64, 48));
    write("cut.jpg", "\xff\xd8\xff");
    write("huge.pgm", "P5 20000 20000 255\n");
    expectOneMessage(run("panorama photo.pgm"), "--out", 2);
    expectOneMessage(run("panorama photo.pgm -o out.png --fov 9"), "--fov", 2);
    expectOneMessage(run("panorama photo.pgm -o out.png --fov 151"), "--fov", 2);
    expectOneMessage(run("panorama photo.pgm -o out.gif"), "out.gif");
    expectOneMessage(run("panorama photo.pgm -o out.hdr"), "out.hdr");
    expectOneMessage(run("panorama /nowhere/there.jpg -o out.png"), "there.jpg");
    expectOneMessage(run("panorama /tmp -o out.png"), "/tmp");
    expectOneMessage(run("panorama cut.jpg -o out.png"), "cut.jpg");
    expectOneMessage(run("panorama huge.pgm -o out.png"), "huge.pgm");
    // Two lines: that it begins, and why it ends.
    for (const auto& [width, height] : {std::pair{1, 1}, {1, 64}, {300, 16}}) {
        const Outcome tiny = run("panorama " + write("tiny.pgm", pnm(width, height)) + " -o out.png");
        EXPECT_EQ(tiny.status, 1);
        EXPECT_NE(tiny.err.find("tiny.pgm: its "), std::string::npos) << tiny.err;
    }
    const Outcome unwritable = run("panorama photo.pgm -o /proc/out.png");
    EXPECT_EQ(unwritable.status, 1);
    EXPECT_NE(unwritable.err.find("/proc/out.png: cannot be written"), std::string::npos) << unwritable.err;
    EXPECT_FALSE(fs::exists(folder_ / "out.png"));
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 6) << "nothing half written";
}

TEST_F(Program, PhotosOfAnyKindBecomeEnvironments) {
    write("photo.ppm", pnm(64, 48, "P6"));
    for (const std::string out : {"out.png", "out.JPG"}) {
        const Outcome grown = run("panorama photo.ppm -o " + out + " --fov 60");
        EXPECT_EQ(grown.status, 0) << grown.err;
        EXPECT_NE(grown.out.find("grown around its light"), std::string::npos) << grown.out;
        const std::string band = textOf(out), check = run("check " + out).out;
        EXPECT_THAT(check, HasSubstr("lat-long mono"));
        EXPECT_EQ(run("panorama photo.ppm -o " + out + " --fov 60 --full").status, 0);
        EXPECT_EQ(run("check " + out).out, check); // its size, and twice as wide as high
        EXPECT_NE(textOf(out), band);
    }
    // Once it is an environment it stays as it is, unless somebody says that it is a photo all the same.
    EXPECT_NE(run("panorama out.png -o again.png").out.find("kept as it is"), std::string::npos);
    // A picture that is no environment by its shape is grown for play and view too.
    const Outcome played =
        run("play --headless --at 0.1 --size 64x36 --photo photo.ppm --screenshot shot.png");
    EXPECT_EQ(played.status, 0) << played.err;
    EXPECT_NE(played.err.find("growing"), std::string::npos) << played.err;
}

TEST_F(Program, PanoramaSaysThatTwoEyesPicturesAreNotLevelled) {
    const Path stereo = tests::sharedDataFolder() / "photo/coral_underwater_360_overunder_2048.jpg";
    if (!fs::exists(stereo)) GTEST_SKIP() << "no shared " << stereo;
    const std::string xmp =
        std::string("http://ns.adobe.com/xap/1.0/\0", 29) +
        R"(<x GPano:ProjectionType="equirectangular" GPano:PosePitchDegrees="10" GPano:PoseRollDegrees="5"/>)";
    std::string jpeg = readText(stereo).value();
    jpeg.insert(2, std::string("\xff\xe1\0", 3) + static_cast<char>(xmp.size() + 2) + xmp);
    const Outcome made = run("panorama " + write("stereo.jpg", jpeg) + " -o out.png");
    EXPECT_NE(made.out.find("not levelled"), std::string::npos) << made.out << made.err;
}

TEST_F(Program, HandsAndDivesThatAreNone) {
    expectOneMessage(run(play_ + "--hands script:/nowhere/s.toml"), "s.toml");
    expectOneMessage(run(play_ + "--hands replay:" + write("r.replay", "SHOALREC")), "r.replay");
    expectOneMessage(run(play_ + "--hands feet"), "feet");
    expectOneMessage(run(play_ + "--dive ../../etc/passwd"), "passwd");
}

TEST_F(Program, AScriptBringsItsOwnDiveAndRules) {
    const std::string script =
        "play --headless --hands script:" + (tests::sourceFolder() / "tests/playthrough/miss.toml").string();
    for (const std::string option :
         {"--dive night", "--seed 3", "--assist none", "--free-swim", "--posture seated", "--reach-help 0"}) {
        const Outcome outcome = run(script + " " + option);
        expectOneMessage(outcome, option.substr(0, option.find(' ')), 2);
    }
}

TEST_F(Program, ARecordingOfAnOlderVersionIsRefusedByName) {
    const std::string file = (tests::sourceFolder() / "tests/robustness/program/version_2.replay").string();
    expectOneMessage(run("play --headless --hands replay:" + file),
                     "has version 2, this game reads version 5");
    expectOneMessage(run("check " + file), "has version 2");
}

// The README's command, from another folder than the script's.
TEST_F(Program, PlaythroughsGiveTheStoredStatesInBothWatersAndTheirRecordingsReplay) {
    for (const auto& [name, inFilm] :
         {std::pair{"shark_steals_night", true}, {"behind_rock", true}, {"mouse", false}}) {
        const std::string file = (tests::sourceFolder() / "tests/playthrough" / name).string() + ".toml";
        const std::string water = inFilm ? "" : " --no-depth";
        const Outcome played =
            run("play --headless --fps 144 --hands script:" + file + water + " --record a.replay");
        EXPECT_EQ(played.status, 0) << played.err;
        EXPECT_EQ(played.out, fmt::format("{} {:016x}\n", name, game::storedHash(name, inFilm)));
        EXPECT_EQ(run("play --headless --hands replay:a.replay" + water).status, 0);
        EXPECT_EQ(run("check a.replay").status, 0);
        fs::remove(folder_ / "a.replay");
    }
    const Path dives = tests::sourceFolder() / "tests/playthrough/dive";
    fs::copy(dives / "cove.toml", folder_ / "gone.toml");
    fs::copy(dives / "species.toml", folder_ / "species.toml");
    EXPECT_EQ(run("play --headless --at 0.1 --dive gone.toml --record gone.replay").status, 0);
    EXPECT_EQ(run("check gone.replay").status, 0);
    fs::remove(folder_ / "gone.toml");
    expectOneMessage(run("check gone.replay"), "its dive cannot be played");
}

TEST_F(Program, AModelThatIsNoneLeavesNoPicture) {
    expectOneMessage(run("view " + write("m.glb", "glTF") + " --out out.png"), "m.glb");
    EXPECT_FALSE(fs::exists(folder_ / "out.png"));
}

// The names of clips are replaced by others of their length.
TEST_F(Program, AnAnimationMayHaveAnAtInItsName) {
    std::string bytes = *readText(tests::sourceFolder() / "content/models/sardine.glb");
    const size_t at = bytes.find("\"dart\"");
    ASSERT_NE(at, std::string::npos);
    write("m.glb", bytes.replace(at, 6, "\"a@9\" "));
    const std::string view = "view m.glb --size 64x64 --out out.png --occlusion off --animation ";
    EXPECT_EQ(run(view + "a@9").status, 0);
    EXPECT_EQ(run(view + "a@9@0.1").status, 0);
    EXPECT_EQ(run(view + "swim@0.1").status, 0);
    expectOneMessage(run(view + "a@8"), "no animation named a;");
    expectOneMessage(run(view + "a@9@x"), "wants NAME@SECONDS");
}

// A table is known by its extension, all else by content.
TEST_F(Program, CheckTellsGoodFromBadByContentNotNames) {
    const Path content = tests::sourceFolder() / "content";
    const auto named = [&](const char* name, const Path& file) { return write(name, *readText(file)) + " "; };
    const Outcome good =
        run("check " + named("dive.toml", content / "dives/reef.toml") +
            named("species.toml", content / "species.toml") + named("model", content / "models/shark.glb") +
            named("photo.mp4", content / "icon.png"));
    EXPECT_EQ(good.status, 0) << good.err;
    for (const char* kind : {"a dive of", "a table of", "a model of", "PNG picture"})
        EXPECT_NE(good.out.find(kind), std::string::npos) << kind << good.out;
    EXPECT_TRUE(good.out.starts_with("usable: ")) << good.out;
    EXPECT_EQ(lines(good.out), 4);
    const Outcome both = run("check " + write("x.png", "PNG") + " dive.toml");
    expectOneMessage(both, "x.png");
    EXPECT_TRUE(both.err.starts_with("not usable: ")) << both.err;
    EXPECT_EQ(lines(both.out), 1) << "goes on";
    expectOneMessage(run("check " + named("readme.toml", tests::sourceFolder() / "README.md")),
                     "readme.toml: line ");
    write("riff", std::string("RIFF=\0\0\0WAVEfmt ", 16)); // no key of TOML
    expectOneMessage(run("check riff"), "riff: is");
}

TEST_F(Program, ShadowsFallWhereverAFilmHasADepthTrack) {
    const Path content = tests::sourceFolder() / "content/video";
    fs::create_symlink(content / "reef.small.mp4", folder_ / "own.mp4");
    const auto picture = [&](const std::string& shadows) {
        const Outcome outcome =
            run("play --headless --size 320x180 --at 1.5 --fps 4 --video own.mp4 --shadows " + shadows +
                " --screenshot " + shadows + ".png");
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        return textOf(shadows + ".png");
    };
    EXPECT_EQ(picture("on"), picture("off"));
    fs::create_symlink(content / "reef.depth.mkv", folder_ / "own.depth.mkv");
    EXPECT_NE(picture("on"), picture("off"));
}

} // namespace
} // namespace shoal
