// The program as a person meets it: bad input gets one sentence on standard error and a non-zero exit, never
// a crash, and nothing half written; scripts and replays end with the status that they promise.
#include "Program.h"
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
    std::string bytes =
        std::string(kind) + " " + std::to_string(width) + " " + std::to_string(height) + " 255\n";
    const int channels = kind[1] == '6' ? 3 : 1;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width * channels; ++x) bytes += static_cast<char>((x / channels + y) % 200 + 20);
    return bytes;
}

class Program : public tests::Program {
  protected:
    const Path picture_ = folder_ / "out.png";

    // Draws a model before a photo.
    Outcome view(const Path& model, const std::string& options) const {
        return run("view " + model.string() + " --photo " + write("photo.ppm", pnm(256, 128, "P6")).string() +
                   " --out " + picture_.string() + " " + options);
    }

    // Files that `light` writes, by name.
    std::map<std::string, std::string> lightFiles(const Path& picture, const Path& out,
                                                  const std::string& how) const {
        const Outcome made = run("light " + picture.string() + " -o " + out.string() + " " + how);
        if (made.status != 0) throw std::runtime_error(made.err);
        std::map<std::string, std::string> files;
        for (const auto& each : fs::directory_iterator(out))
            files[each.path().filename().string()] = readText(each.path()).value();
        return files;
    }
};

// Loading the libraries would take a tenth of a second and an eighth of the memory (engine/media/Codecs.h).
TEST_F(Program, StartsWithoutTheLibrariesOfPicturesAndCameras) {
    const Path list = folder_ / "libraries.txt";
    const std::string command =
        std::string("LD_TRACE_LOADED_OBJECTS=1 '") + tests::program() + "' >" + list.string();
    ASSERT_EQ(std::system(command.c_str()), 0);
    const auto libraries = tests::valueOf(readText(list));
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
    expectOneMessage(run("play --nonsense"), "--nonsense", 2);
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
    const std::string play = "play --headless --at 0.1 --size 64x36 ", file = folder_.string() + "/none/out";
    expectOneMessage(run(play + "--screenshot " + folder_.string() + "/x.gif"), "x.gif");
    expectOneMessage(run(play + "--screenshot " + file + ".png"), "/none");
    expectOneMessage(run(play + "--record " + file + ".replay"), "/none");
    expectOneMessage(run(play + "--stats " + file + ".json"), "/none");
    expectOneMessage(run("view m.glb --out " + folder_.string() + "/x.gif"), "x.gif");
    expectOneMessage(run("view m.glb --out " + file + ".png"), "/none");
    expectOneMessage(run("panorama p.jpg -o " + file + ".png"), "/none");
    EXPECT_FALSE(fs::exists(folder_ / "none"));
}

TEST_F(Program, DepthOfAStillCameraCannotBeKnown) {
    const Path film = folder_ / "still.avi", out = folder_ / "still.depth.mkv";
    cv::Mat picture(128, 256, CV_8UC3);
    cv::RNG(3).fill(picture, cv::RNG::UNIFORM, 0, 255);
    media::writeFilm(
        film, "MJPG", 12, [&](int) { return picture; }, 24);
    expectOneMessage(run(film.string() + " -o " + out.string(), depthProgram()), "cannot be known", 3);
    EXPECT_FALSE(fs::exists(out));
    EXPECT_FALSE(fs::exists(out.string() + ".part"));
}

// The output is checked before a frame is read: of two errors here, the message names the output.
TEST_F(Program, DepthIsMadeOfFilesAndHasToHaveAPlace) {
    const std::string out = " -o " + folder_.string() + "/out.mkv";
    expectOneMessage(run("rtsp://localhost/live" + out, depthProgram()), "depth is made of files");
    expectOneMessage(run("camera:0" + out, depthProgram()), "depth is made of files");
    expectOneMessage(run(folder_.string() + out, depthProgram()), "depth is made of files");
    expectOneMessage(run((folder_ / "none.mp4").string() + out, depthProgram()), "none.mp4");
    const Path text = write("film.mp4", "no film, but text");
    expectOneMessage(run(text.string() + out, depthProgram()), "film.mp4");
    const std::string nowhere = folder_.string() + "/none/out.mkv";
    expectOneMessage(run(text.string() + " -o " + nowhere, depthProgram()), "/none");
    expectOneMessage(run(text.string() + " -o " + folder_.string(), depthProgram()), "it is a folder");
    expectOneMessage(run(text.string() + " -o " + text.string(), depthProgram()), "film.mp4");
    expectOneMessage(run(text.string() + out + " --preview " + folder_.string() + "/x.gif", depthProgram()),
                     "x.gif");
    EXPECT_FALSE(fs::exists(folder_ / "none"));
    EXPECT_FALSE(fs::exists(folder_ / "out.mkv"));
    EXPECT_FALSE(fs::exists(folder_ / "out.mkv.part"));
    EXPECT_EQ(readText(text).value(), "no film, but text");
}

// A model without an occlusion file gets one, once, with the same content as the stored file of the same
// model.
TEST_F(Program, OcclusionOfAModelIsMadeOnceAndKept) {
    const Path stored = tests::sourceFolder() / "content/models/angelfish.glb", copy = folder_ / "copy.glb";
    fs::copy_file(stored, copy);
    const auto draw = [&](const Path& model, const std::string& about = "") {
        const Outcome outcome = view(model, "--size 64x64");
        EXPECT_EQ(outcome.status, 0);
        EXPECT_NE(outcome.err.find(about), std::string::npos) << outcome.err;
        EXPECT_EQ(lines(outcome.err), about.empty() ? 0 : 1) << outcome.err;
        return readText(picture_).value();
    };
    const std::string shaded = draw(stored);
    const Path cache = folder_ / "shoal";
    write("shoal", "no folder"); // so that nothing can be kept
    EXPECT_NE(draw(copy, "copy.glb: is shown without"), shaded);
    fs::remove(cache);
    EXPECT_EQ(draw(copy), shaded);
    const fs::directory_iterator kept(cache / "occlusion");
    const auto made = fs::last_write_time(kept->path());
    EXPECT_EQ(draw(copy), shaded);
    EXPECT_EQ(fs::last_write_time(kept->path()), made);
}

// Each choice changes the picture, and its older name means the same.
TEST_F(Program, WaysOfLightingCanBeChosen) {
    const Path model = tests::sourceFolder() / "content/models/angelfish.glb";
    const auto draw = [&](const std::string& options) {
        const Outcome outcome = view(model, "--size 64x64 " + options);
        EXPECT_EQ(outcome.status, 0) << options << outcome.err;
        return textOf("out.png");
    };
    const std::string ours = draw("");
    EXPECT_EQ(draw("--occlusion ellipsoids --diffuse default --glossy ggx"), ours);
    EXPECT_EQ(draw("--occlusion ellipsoids"), ours);
    EXPECT_NE(draw("--occlusion off"), ours);
    EXPECT_NE(draw("--diffuse thesis"), ours);
    EXPECT_NE(draw("--glossy phong36"), ours);
    const std::string thesis = draw("--diffuse thesis");
    EXPECT_EQ(draw("--diffuse thesis --diffuse-size 64"), thesis);
    EXPECT_NE(draw("--diffuse thesis --diffuse-size 16"), thesis);
    EXPECT_NE(draw("--light akyuz"), ours);
    EXPECT_NE(draw("--light landis"), draw("--light akyuz"));
}

// Below OpenGL 4.3 one sentence says so. If the driver cannot lower its version, a picture is drawn.
TEST_F(Program, LayersNeedANewerOpenGl) {
    const Path model = tests::sourceFolder() / "content/models/angelfish.glb";
    setenv("MESA_GL_VERSION_OVERRIDE", "3.3", 1);
    const Outcome old = view(model, "--size 32x32 --occlusion ollfb"),
                  thesis = view(model, "--size 32x32 --occlusion ollfb-thesis");
    unsetenv("MESA_GL_VERSION_OVERRIDE");
    if (old.status == 0 && thesis.status == 0) GTEST_SKIP() << "this driver cannot be made old";
    expectOneMessage(old, "layers need OpenGL 4.3; this is 3.3");
    expectOneMessage(thesis, "layers need OpenGL 4.3; this is 3.3");
    EXPECT_FALSE(fs::exists(picture_));
}

TEST_F(Program, LightByTheThesisHasTheSameFiles) {
    const Path photo = write("photo.ppm", pnm(256, 128, "P6"));
    const auto ours = lightFiles(photo, folder_ / "default", "--method default --light thesis"),
               thesis = lightFiles(photo, folder_ / "thesis", "--method thesis");
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

// Grey all around, of sRGB 188: each map is that, in its own size; only the sum over 16 x 8 texels is a
// little off.
TEST_F(Program, LightHasTheMapsThatAreAskedFor) {
    std::string grey = "P6 256 128 255\n" + std::string(256 * 128 * 3, '\xbc');
    const Path photo = write("photo.ppm", grey);
    for (const std::string method : {"default", "thesis"})
        for (const int width : {16, 32, 64, 128, 256}) {
            const auto files = lightFiles(photo, folder_ / (method + std::to_string(width)),
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

// White above, dark grey below: clipped light is estimated by auto alone, and the thesis' operator scales
// all.
TEST_F(Program, LightOfCodedValuesAsAsked) {
    std::string picture =
        "P6 256 128 255\n" + std::string(256 * 64 * 3, '\xff') + std::string(256 * 64 * 3, '\x40');
    const Path photo = write("photo.ppm", picture);
    const auto of = [&](const std::string& how) {
        return lightFiles(photo, folder_ / how, "--light " + how).at("diffuse.pfm");
    };
    const std::string automatic = of("auto"), thesis = of("thesis"), linear = of("linear");
    EXPECT_EQ(lightFiles(photo, folder_ / "unsaid", "").at("diffuse.pfm"), automatic);
    EXPECT_NE(automatic, linear);
    EXPECT_NE(automatic, thesis);
    EXPECT_NE(thesis, linear);
    EXPECT_NE(of("akyuz"), of("landis"));
    EXPECT_NE(of("landis"), linear);
    EXPECT_EQ(run("light " + photo.string() + " -o " + (folder_ / "none").string() + " --light ours").status,
              2);
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
    const auto said = [&](const std::string& material) {
        return run("check " + triangle(material).string()).out;
    };
    const std::string clear = R"("pbrMetallicRoughness":{"baseColorFactor":[1,1,1,0]})";
    EXPECT_THAT(said(R"({"alphaMode":"BLEND",)" + clear + "}"), HasSubstr("wholly transparent"));
    EXPECT_THAT(said(R"({"alphaMode":"MASK",)" + clear + "}"), HasSubstr("wholly transparent"));
    EXPECT_THAT(said("{" + clear + "}"),
                AllOf(HasSubstr("a model of 1 triangle"), Not(HasSubstr("transparent"))));
}

TEST_F(Program, LayersOfWhatHasNoneAreRefused) {
    const std::string photo = write("photo.ppm", "P6\n2 1\n255\n" + std::string(6, 'x')).string();
    for (const std::string& words :
         {"check " + photo, std::string("check camera:0"), "play --headless --video " + photo,
          "play --headless --photo " + photo, "panorama " + photo + " -o " + photo + ".png",
          "light " + photo + " -o " + photo + ".light",
          "check " + (dataRoot() / "content/species.toml").string()})
        expectOneMessage(run(words + " --layer a"), "has no layers; leave --layer out", 1);
}

TEST_F(Program, HeadlessIsAcceptedByEveryCommand) {
    for (const char* command : {"play", "view", "light", "panorama", "check", "devices"})
        EXPECT_NE(run(std::string(command) + " --help").out.find("--headless"), std::string::npos) << command;
    EXPECT_EQ(run("check --headless " + (dataRoot() / "content/species.toml").string()).status, 0);
    expectOneMessage(run("view --headless model.glb"), "--out", 2);
}

TEST_F(Program, HeadlessRunsDoNotDependOnThePlayersSettings) {
    std::filesystem::create_directories(folder_ / "shoal");
    write("shoal/settings.json", "broken");
    EXPECT_NE(run("play").err.find("settings.json"), std::string::npos);
    EXPECT_EQ(run("play --headless --mute --size 64x64 --at 0.1").err.find("settings.json"),
              std::string::npos);
}

TEST_F(Program, ABrokenScoresFileIsSaidOnce) {
    std::filesystem::create_directories(folder_ / "shoal");
    write("shoal/scores.json", "broken");
    const std::string picture = (folder_ / "a.png").string();
    const std::string err = run("play --headless --mute --size 64x64 --at 0.1 --screenshot " + picture).err;
    const size_t first = err.find("scores.json");
    ASSERT_NE(first, std::string::npos);
    EXPECT_EQ(err.find("scores.json", first + 1), std::string::npos) << err;
}

TEST_F(Program, WithoutADisplayItSaysHowToSeeSomething) { expectOneMessage(run("play"), "--headless"); }

// A start from a menu has a display and no terminal. A fake of the program that shows message boxes records
// the text that it is given.
TEST_F(Program, StartedFromAMenuItTellsItsErrorsInAMessageBox) {
    const Path box = folder_ / "box.txt",
               fake = write("zenity", "#!/bin/sh\nprintf '%s\\n' \"$@\" >" + box.string());
    fs::permissions(fake, fs::perms::owner_all);
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
    const Path empty = write("empty.mp4", ""), text = write("text.mp4", "not a video"),
               photo = write("cut.jpg", "\xff\xd8\xff");
    const std::string play = "play --headless --at 0.1 --size 64x36 ";
    expectOneMessage(run(play + "--video /nowhere/there.mp4"), "there.mp4");
    expectOneMessage(run(play + "--video " + empty.string()), "empty.mp4");
    expectOneMessage(run(play + "--video " + text.string()), "text.mp4");
    expectOneMessage(run(play + "--photo " + photo.string()), "cut.jpg");
    expectOneMessage(run(play + "--env " + photo.string()), "cut.jpg");
    expectOneMessage(run(play + "--video " + folder_.string()), folder_.string());
    expectOneMessage(run(play + "/nowhere/there.mp4"), "there.mp4");
    expectOneMessage(run(play + folder_.string()), folder_.string());
    expectOneMessage(run(play + photo.string() + " --photo " + photo.string()), "--photo", 2);
}

// A desktop opens files by their content, whatever they are called.
TEST_F(Program, AFileAloneIsTheEnvironmentThatItHolds) {
    const Path photo = write("some photo.mp4", pnm(256, 128, "P6")), named = folder_ / "named.png",
               alone = folder_ / "alone.png";
    const std::string options = " --headless --at 0.1 --size 64x36 --screenshot ";
    const std::string quoted = "'" + photo.string() + "'";
    ASSERT_EQ(run("play --photo " + quoted + options + named.string()).status, 0);
    const Outcome outcome = run(quoted + options + alone.string());
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(readText(alone).value(), readText(named).value());
}

TEST_F(Program, PanoramasThatCannotBe) {
    const Path photo = write("photo.pgm", pnm(64, 48)), out = folder_ / "out.png";
    const std::string to = " -o " + out.string();
    expectOneMessage(run("panorama " + photo.string()), "--out", 2);
    expectOneMessage(run("panorama " + photo.string() + to + " --fov 9"), "--fov", 2);
    expectOneMessage(run("panorama " + photo.string() + to + " --fov 151"), "--fov", 2);
    expectOneMessage(run("panorama " + photo.string() + " -o " + (folder_ / "out.gif").string()), "out.gif");
    expectOneMessage(run("panorama " + photo.string() + " -o " + (folder_ / "out.hdr").string()), "out.hdr");
    expectOneMessage(run("panorama /nowhere/there.jpg" + to), "there.jpg");
    expectOneMessage(run("panorama " + folder_.string() + to), folder_.string());
    expectOneMessage(run("panorama " + write("cut.jpg", "\xff\xd8\xff").string() + to), "cut.jpg");
    expectOneMessage(run("panorama " + write("huge.pgm", "P5 20000 20000 255\n").string() + to), "huge.pgm");
    // Two lines: that it begins, and why it ends.
    for (const auto& [width, height] : {std::pair{1, 1}, {1, 64}, {300, 16}}) {
        const Outcome tiny = run("panorama " + write("tiny.pgm", pnm(width, height)).string() + to);
        EXPECT_EQ(tiny.status, 1);
        EXPECT_NE(tiny.err.find("tiny.pgm: its "), std::string::npos) << tiny.err;
    }
    const Outcome unwritable = run("panorama " + photo.string() + " -o /proc/out.png");
    EXPECT_EQ(unwritable.status, 1);
    EXPECT_NE(unwritable.err.find("/proc/out.png: cannot be written"), std::string::npos) << unwritable.err;
    EXPECT_FALSE(fs::exists(out));
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()),
              6); // nothing half written
}

TEST_F(Program, PhotosOfAnyKindBecomeEnvironments) {
    const std::string photo = write("photo.ppm", pnm(64, 48, "P6")).string();
    for (const char* name : {"out.png", "out.JPG"}) {
        const std::string out = (folder_ / name).string();
        const Outcome grown = run("panorama " + photo + " -o " + out + " --fov 60");
        EXPECT_EQ(grown.status, 0) << grown.err;
        EXPECT_NE(grown.out.find("grown around its light"), std::string::npos) << grown.out;
        const std::string band = textOf(name), check = run("check " + out).out;
        EXPECT_THAT(check, HasSubstr("lat-long mono"));
        EXPECT_EQ(run("panorama " + photo + " -o " + out + " --fov 60 --full").status, 0);
        EXPECT_EQ(run("check " + out).out, check); // its size, and twice as wide as high
        EXPECT_NE(textOf(name), band);
    }
    // Once it is an environment it stays as it is, unless somebody says that it is a photo all the same.
    const std::string full = (folder_ / "out.png").string(), again = (folder_ / "again.png").string();
    EXPECT_NE(run("panorama " + full + " -o " + again).out.find("kept as it is"), std::string::npos);
    // A picture that is no environment by its shape is grown for play and view too.
    const Outcome played = run("play --headless --at 0.1 --size 64x36 --photo " + photo + " --screenshot " +
                               (folder_ / "shot.png").string());
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
    const Outcome made = run("panorama " + write("stereo.jpg", jpeg).string() + " -o " + picture_.string());
    EXPECT_NE(made.out.find("not levelled"), std::string::npos) << made.out << made.err;
}

TEST_F(Program, HandsAndDivesThatAreNone) {
    const std::string play = "play --headless --at 0.1 --size 64x36 ";
    expectOneMessage(run(play + "--hands script:/nowhere/s.toml"), "s.toml");
    expectOneMessage(run(play + "--hands replay:" + write("r.replay", "SHOALREC").string()), "r.replay");
    expectOneMessage(run(play + "--hands feet"), "feet");
    expectOneMessage(run(play + "--dive ../../etc/passwd"), "passwd");
    expectOneMessage(run(play + "--dive none"), "none");
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
        const Path replay = folder_ / (std::string(name) + ".replay");
        const std::string water = inFilm ? "" : " --no-depth";
        const Outcome played =
            run("play --headless --fps 144 --hands script:" + file + water + " --record " + replay.string());
        EXPECT_EQ(played.status, 0) << played.err;
        std::istringstream stored(readText(tests::sourceFolder() / "tests/equal_hashes.txt").value());
        std::string word, open, film;
        while (stored >> word >> open >> film && word != name) {
        }
        EXPECT_EQ(played.out, std::string(name) + " " + (inFilm ? film : open) + "\n");
        const std::string from =
            "cd / && '" + tests::program() + "' play --headless --hands replay:" + replay.string() + water;
        EXPECT_EQ(std::system(from.c_str()), 0);
        EXPECT_EQ(run("check " + replay.string()).status, 0);
    }
    const Path gone = folder_ / "gone.toml";
    std::ofstream(gone) << readText(tests::sourceFolder() / "tests/playthrough/dive/cove.toml").value();
    fs::copy(tests::sourceFolder() / "tests/playthrough/dive/species.toml", folder_ / "species.toml");
    const Path replay = folder_ / "gone.replay";
    EXPECT_EQ(run("play --headless --at 0.1 --dive " + gone.string() + " --record " + replay.string()).status,
              0);
    EXPECT_EQ(run("check " + replay.string()).status, 0);
    fs::remove(gone);
    expectOneMessage(run("check " + replay.string()), "its dive cannot be played");
}

TEST_F(Program, AModelThatIsNoneLeavesNoPicture) {
    const Path out = folder_ / "out.png";
    expectOneMessage(run("view " + write("m.glb", "glTF").string() + " --out " + out.string()), "m.glb");
    EXPECT_FALSE(fs::exists(out));
}

// The names of clips are replaced by others of their length.
TEST_F(Program, AnAnimationMayHaveAnAtInItsName) {
    std::string bytes = *readText(tests::sourceFolder() / "content/models/sardine.glb");
    const size_t at = bytes.find("\"dart\"");
    ASSERT_NE(at, std::string::npos);
    const std::string model = write("m.glb", bytes.replace(at, 6, "\"a@9\" ")).string();
    const std::string view =
        "view " + model + " --size 64x64 --out " + (folder_ / "out.png").string() + " --animation ";
    EXPECT_EQ(run(view + "a@9").status, 0);
    EXPECT_EQ(run(view + "a@9@0.1").status, 0);
    EXPECT_EQ(run(view + "swim@0.1").status, 0);
    expectOneMessage(run(view + "a@8"), "no animation named a;");
    expectOneMessage(run(view + "a@9@x"), "wants NAME@SECONDS");
}

// A table is known by its extension, all else by content.
TEST_F(Program, CheckTellsGoodFromBadByContentNotNames) {
    const Path content = tests::sourceFolder() / "content";
    const auto named = [&](const char* name, const Path& file) {
        return write(name, *readText(file)).string() + " ";
    };
    const Outcome good =
        run("check " + named("dive.toml", content / "dives/reef.toml") +
            named("species.toml", content / "species.toml") + named("model", content / "models/shark.glb") +
            named("photo.mp4", content / "icon.png"));
    EXPECT_EQ(good.status, 0) << good.err;
    for (const char* kind : {"a dive of", "a table of", "a model of", "PNG picture"})
        EXPECT_NE(good.out.find(kind), std::string::npos) << kind << good.out;
    EXPECT_TRUE(good.out.starts_with("usable: ")) << good.out;
    EXPECT_EQ(lines(good.out), 4);
    const Outcome both =
        run("check " + write("x.png", "PNG").string() + " " + (content / "dives/reef.toml").string());
    expectOneMessage(both, "x.png");
    EXPECT_TRUE(both.err.starts_with("not usable: ")) << both.err;
    EXPECT_EQ(lines(both.out), 1) << "goes on";
    expectOneMessage(run("check " + named("readme.toml", tests::sourceFolder() / "README.md")),
                     "readme.toml: line ");
    const Path riff = write("riff", std::string("RIFF=\0\0\0WAVEfmt ", 16)); // no key of TOML
    expectOneMessage(run("check " + riff.string()), "riff: is");
}

TEST_F(Program, TheSameMomentGivesTheSamePicture) {
    const Path a = folder_ / "a.png", b = folder_ / "b.png";
    const std::string play = "play --headless --size 160x90 --at 0.5 --fps 10 --screenshot ";
    ASSERT_EQ(run(play + a.string()).status, 0);
    ASSERT_EQ(run(play + b.string()).status, 0);
    EXPECT_EQ(readFile(a, 1u << 20).value(), readFile(b, 1u << 20).value());
}

// Shadows need only the film's distances.
TEST_F(Program, ShadowsFallWhereverAFilmHasADepthTrack) {
    const Path film = folder_ / "own.mp4", content = tests::sourceFolder() / "content/video";
    fs::create_symlink(content / "reef.small.mp4", film);
    const auto picture = [&](const std::string& shadows) {
        const Path file = folder_ / (shadows + ".png");
        EXPECT_EQ(run("play --headless --size 320x180 --at 3 --fps 4 --video " + film.string() +
                      " --shadows " + shadows + " --screenshot " + file.string())
                      .status,
                  0);
        return readFile(file, 1u << 20).value();
    };
    EXPECT_EQ(picture("on"), picture("off"));
    fs::create_symlink(content / "reef.depth.mkv", folder_ / "own.depth.mkv");
    EXPECT_NE(picture("on"), picture("off"));
}

} // namespace
} // namespace shoal
