// Invalid numbers are refused wherever they come from: one sentence names the option or the key.
#include "Program.h"

#include <span>

namespace shoal {
namespace {

struct Place {
    std::string text; // with a number in place of the #
    std::string named;
};

class Numbers : public tests::Program {
  protected:
    // Calls use(text) with each of these in place of the #.
    template <class Use>
    static void fill(const std::string& with, std::span<const char* const> words, const Use& use) {
        for (const char* word : words) {
            std::string text = with;
            text.replace(text.find('#'), 1, word);
            SCOPED_TRACE(text);
            use(text);
        }
    }

    // Expects that a file of that name, which the arguments read, is refused.
    void expectRefused(const std::string& name, const std::string& arguments, const Place& place,
                       std::span<const char* const> words) const {
        fill(place.text, words, [&](const std::string& text) {
            write(name, text);
            expectOneMessage(run(arguments), place.named);
        });
    }
};

// Two kinds tell an option that reads numbers in another way; the next test has all kinds.
TEST_F(Numbers, OptionsRefuseThem) {
    constexpr std::array kNone = {"nan", "0x1p3"};
    for (const auto& [command, options] : std::map<std::string, std::vector<std::string>>{
             {"play --headless",
              {"env-yaw", "text-size", "fps", "at", "exposure", "fov", "speed", "seed", "volume",
               "effects-volume", "music", "video-sound", "haptics", "hand-size", "sensitivity", "reach-help",
               "eye-distance"}},
             {"view m.glb --out a.png", {"fov", "at", "exposure", "env-yaw", "samples"}},
             {"light a.hdr -o out", {"at", "roughness"}},
             {"view m.glb --occlusion ollfb", {"ollfb-views", "ollfb-size"}},
             {"panorama a.jpg -o a.png", {"fov"}}})
        for (const std::string& option : options)
            fill(command + " --" + option + "='#'", kNone, [&](const std::string& words) {
                expectOneMessage(run(words), "--" + option + ": wants", 2);
            });
    fill("a.mp4 -o a.mkv --height='#'", kNone, [&](const std::string& words) {
        expectOneMessage(run(words, depthProgram()), "--height: wants", 2);
    });
}

TEST_F(Numbers, EveryKindThatIsNoneIsRefused) {
    constexpr std::array kNone = {"-nan",   "NaN", "nan(1)", "inf", "infinity", "1e",
                                  "1e-999", " 5",  "5 ",     "+-5", "0,5"};
    fill("play --headless --env-yaw='#'", kNone, [&](const std::string& words) {
        expectOneMessage(run(words), "--env-yaw: wants a number from -360 to 360 (shoal play --help", 2);
    });
}

TEST_F(Numbers, OptionsThatHoldSeveralRefuseThem) {
    constexpr std::array kNone = {"nan", "0x10", "", " 5"};
    const std::vector<Place> places = {
        {"view m.glb --out a.png --orbit='#,0,1'", "--orbit: wants"},
        {"view m.glb --out a.png --orbit='0,90,#'", "--orbit: wants"},
        {"view m.glb --out a.png --target='0,#,1'", "--target: wants"},
        {"light a.hdr -o out --roughness='0.1,#'", "--roughness: wants"},
        {"light a.hdr -o out --roughness='#,0.1'", "--roughness: wants"},
        {"play --headless --size='#x64'", "--size: wants"},
        {"play --headless --size='64x#'", "--size: wants"},
        {"play --headless --leap='localhost:#'", "--leap: wants"},
        {"devices --leap='localhost:#'", "--leap: wants"},
    };
    for (const Place& place : places)
        fill(place.text, kNone,
             [&](const std::string& words) { expectOneMessage(run(words), place.named, 2); });
    for (const char* words :
         {"view m.glb --out a.png --orbit=1e30,0,1", "view m.glb --out a.png --orbit=0,90",
          "view m.glb --out a.png --orbit=0,90,1,1", "light a.hdr -o out --roughness=0.2,0.2",
          "light a.hdr -o out --roughness=0.5,1.01", "light a.hdr -o out --roughness=0",
          "view m.glb --occlusion ollfb --ollfb-views=5", "view m.glb --occlusion ollfb --ollfb-size=257",
          "play --headless --size=4294967360x64", "play --headless --leap=localhost:4294967297",
          "play --headless --leap=:80"})
        expectOneMessage(run(words), ": wants", 2);
    expectOneMessage(run("check camera:nan"), "camera:nan");
}

// A plus, a fraction alone and an exponent are read; zeros before a number change nothing.
TEST_F(Numbers, AllUsualFormsAreRead) {
    for (const char* words : {"--fov=+65", "--exposure=-.5", "--fov=6.5e1", "--text-size=1.6", "--seed=08"})
        EXPECT_EQ(run("play --headless --at=0 --size=64x36 " + std::string(words)).status, 0) << words;
}

TEST_F(Numbers, SettingsRefuseThem) {
    std::filesystem::create_directories(folder_ / "shoal");
    constexpr std::array kNone = {"nan", "1e999", "1e300"};
    for (const char* settings : {R"({"fov": #})", R"({"text-size": #})", R"({"exposure": #})",
                                 R"({"leap": "local:#"})", R"({"volume": "#"})"})
        fill(settings, kNone, [&](const std::string& text) {
            write("shoal/settings.json", text);
            const std::string err = run("play").err; // fails because there is no display
            EXPECT_NE(err.find("settings.json: "), std::string::npos) << err;
            EXPECT_NE(err.find("--headless"), std::string::npos) << err;
            EXPECT_EQ(lines(err), 2) << err;
        });
}

TEST_F(Numbers, TomlFilesRefuseThem) {
    constexpr std::array kNone = {"nan", "-inf", "1e300"};
    constexpr std::array kNotEvenToml = {"1e999"}; // of which the line is named
    const std::string species = "[[species]]\nname = \"a\"\nmodel = \"a.glb\"\nlength = ",
                      dive = "[[school]]\nspecies = \"clownfish\"\ncount = ",
                      shark = dive + "3\n[shark]\nspecies = \"shark\"\n",
                      whale = dive + "3\n[encounter]\nspecies = \"whale\"\n",
                      step = "[[step]]\ndo = \"wait\"\n";
    const std::vector<Place> places = {
        {species + "#\n", "line 4: \"length\""},
        {species + "0.2\ncruise = #\n", "line 5: \"cruise\""},
        {species + "0.2\nspacing = #\n", "line 5: \"spacing\""},
        {"duration = #\n" + dive + "3\n", "line 1: \"duration\""},
        {"lamp = #\n" + dive + "3\n", "line 1: \"lamp\""},
        {dive + "#\n", "line 3: \"count\""},
        {dive + "3\nradius = [1, #]\n", "line 4: \"radius\""},
        {dive + "3\nheight = [#, 1]\n", "line 4: \"height\""},
        {shark + "radius = #\n", "line 6: \"radius\""},
        {shark + "visits = [10, #]\n", "line 6: \"visits\""},
        {whale + "at = #\nfrom = [-9, 3, 0]\nto = [9, 3, 0]\n", "line 6: \"at\""},
        {whale + "at = 9\nfrom = [-9, #, 0]\nto = [9, 3, 0]\n", "line 7: \"from\""},
        {step + "seconds = #\n", "line 3: \"seconds\""},
        {step + "[[step]]\ndo = \"look\"\nyaw_deg = #\n", "line 5: \"yaw_deg\""},
        {"seed = #\n" + step, "line 1: \"seed\""},
        {"timeout = #\n" + step, "line 1: \"timeout\""},
        {step + "[[expect]]\nevent = \"catch\"\nbefore = #\n", "line 5: \"before\""},
    };
    for (const auto& [text, named] : places) {
        expectRefused("a.toml", "check a.toml", {text, named}, kNone);
        expectRefused("a.toml", "check a.toml", {text, named.substr(0, named.find(':'))}, kNotEvenToml);
    }
}

TEST_F(Numbers, PicturesThatHoldThemAsTextAreRefused) {
    constexpr std::array kNone = {"nan", "-inf", "1e999", "0x1p3", "1x", "0"};
    const Place scale{"PF\n2 1\n#\n" + std::string(24, '\0'), "a.pfm: its PFM header is damaged"};
    expectRefused("a.pfm", "light a.pfm -o out", scale, kNone);
    EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
}

} // namespace
} // namespace shoal
