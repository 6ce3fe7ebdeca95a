// The game as a package brings it: it runs from where it is installed, wherever that is, and what describes
// it to desktops, shops and readers agrees with the program.
#include "engine/core/Files.h"
#include "tests/TestPaths.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <iterator>
#include <regex>
#include <set>
#include <sstream>
#include <sys/wait.h>

namespace shoal {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

const Path kScratch = SHOAL_SCRATCH, kMetadata = "share/metainfo/org.shoalgame.shoal.metainfo.xml";

std::string quoted(const Path& path) { return "'" + path.string() + "'"; }

struct Outcome {
    int status;
    std::string said; // on standard output and standard error
};

Outcome run(const std::string& command) {
    const Path file = kScratch / "said.txt";
    const int status = std::system(("(" + command + ") >" + quoted(file) + " 2>&1 </dev/null").c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, readText(file).value()};
}

// Errors and warnings of appstreamcli and lintian, but those of newer versions that have no cure: there is no
// homepage, and the game wants to be offered to nobody for their gamepad.
std::string complaints(const Outcome& outcome) {
    static const std::regex known(
        "url-homepage-missing|appstream-metadata-(validation-failed|missing-modalias-provide)");
    std::istringstream lines(outcome.said);
    std::string found;
    for (std::string line; std::getline(lines, line);)
        if ((line.starts_with("E: ") || line.starts_with("W: ")) && !std::regex_search(line, known))
            found += line + "\n";
    return found;
}

bool installed(const std::string& tool) { return run("command -v " + tool).status == 0; }

class Package : public testing::Test {
  protected:
    // Installed for one folder and moved to another, as packages and containers do.
    static void SetUpTestSuite() {
        fs::remove_all(kScratch);
        fs::create_directories(kScratch);
        const Outcome outcome = run(std::string(SHOAL_CMAKE) + " --install " + quoted(SHOAL_BUILD) +
                                    " --prefix " + quoted(kScratch / "the prefix"));
        ASSERT_EQ(outcome.status, 0) << outcome.said;
        fs::rename(kScratch / "the prefix", prefix());
    }
    static Path prefix() { return kScratch / "moved"; }
    static std::string game() {
        return "env -u SHOAL_DATA XDG_CONFIG_HOME=" + quoted(kScratch) + " " +
               quoted(prefix() / "games/shoal") + " ";
    }
    static std::string text(const Path& file) {
        if (file.extension() == ".gz") return run("gzip -dc " + quoted(prefix() / file)).said;
        const auto read = readText(prefix() / file);
        EXPECT_TRUE(read) << read.error().message();
        return read ? *read : "";
    }
    static std::string version() {
        const std::string said = run(game() + "--version").said;
        return said.substr(0, said.find_first_of(" \n")); // the commit follows
    }
};

TEST_F(Package, RunsFromWhereItIs) {
    const Path dives = prefix() / "share/games/shoal/content/dives";
    fs::copy_file(dives / "reef.toml", dives / "zz_added.toml");
    EXPECT_THAT(run(game() + "--headless --dive none").said, HasSubstr("zz_added")) << "reads other data";
    fs::remove(dives / "zz_added.toml");
    const Path picture = kScratch / "picture.png",
               photo = prefix() / "share/icons/hicolor/256x256/apps/shoal.png";
    const Outcome dive = run(game() + "--headless --at 0.1 --size 64x36 --screenshot " + quoted(picture));
    EXPECT_EQ(dive.status, 0) << dive.said;
    EXPECT_TRUE(fs::exists(picture));
    // Pictures are decoded by a library that is loaded when it is needed.
    const Outcome check = run("LD_DEBUG=files " + game() + "check " + quoted(photo));
    EXPECT_THAT(check.said, HasSubstr("usable: " + photo.string()));
    EXPECT_THAT(check.said, HasSubstr((prefix() / "lib/games/shoal/libshoal_codecs.so").string()));
    // A program beside it makes the occlusion of models that have none.
    const Path copy = kScratch / "copy.glb";
    fs::copy_file(prefix() / "share/games/shoal/content/models/sardine.glb", copy);
    const Outcome viewed =
        run("env XDG_CACHE_HOME=" + quoted(kScratch) + " " + game() + "view " + quoted(copy) + " --photo " +
            quoted(photo) + " --size 64x64 --out " + quoted(picture));
    EXPECT_EQ(viewed.status, 0) << viewed.said;
    EXPECT_THAT(viewed.said, testing::Not(HasSubstr("is shown without")));
}

TEST_F(Package, HoldsWhatIsPlayedAndNotWhatMakesIt) {
    const Path content = prefix() / "share/games/shoal/content";
    for (const char* name : {"make", "truth", "glove", "udev", "package"})
        EXPECT_FALSE(fs::exists(content / name)) << name;
    for (const char* name : {"video/reef.depth.mkv", "fonts/text.otf", "fonts/heading.otf", "fonts/OFL.txt"})
        EXPECT_TRUE(fs::exists(content / name)) << name;
    for (const auto& entry : fs::recursive_directory_iterator(prefix()))
        EXPECT_EQ(entry.status().permissions() & fs::perms::others_read, fs::perms::others_read)
            << entry.path();
    EXPECT_TRUE(fs::exists(prefix() / "lib/udev/rules.d/70-shoal-haptics.rules"));
}

TEST_F(Package, SaysOneVersionEverywhere) {
    EXPECT_THAT(version(), testing::MatchesRegex("[0-9]+\\.[0-9]+\\.[0-9]+"));
    const std::string said = run(game() + "--version").said;
    EXPECT_THAT(said, testing::ContainsRegex("^[0-9.]+( \\([0-9a-f]+\\))?\n$"));
    EXPECT_EQ(run(quoted(prefix() / "games/shoal-depth") + " --version").said, said);
    const std::string changes = readText(tests::sourceFolder() / "content/package/CHANGELOG.md").value();
    EXPECT_THAT(changes.substr(changes.find("\n## ")), testing::StartsWith("\n## " + version() + ", "));
    EXPECT_THAT(text("share/doc/shoal/changelog.gz"), testing::StartsWith("shoal (" + version() + ")"));
    EXPECT_THAT(text("share/man/man6/shoal.6.gz"), HasSubstr("Shoal " + version()));
    EXPECT_THAT(text(kMetadata), HasSubstr("version=\"" + version() + "\""));
}

TEST_F(Package, ManualPageNamesOnlyOptionsThatThereAre) {
    const std::string page = std::regex_replace(text("share/man/man6/shoal.6.gz"), std::regex("\\\\-"), "-");
    std::string help = run(quoted(prefix() / "games/shoal-depth") + " --help").said;
    for (const char* command : {"play", "view", "light", "panorama", "check", "devices"}) {
        help += run(game() + command + " --help").said;
        EXPECT_THAT(page, HasSubstr(command));
    }
    const std::regex option("--[a-z][a-z-]*");
    std::set<std::string> named;
    for (std::sregex_iterator at(page.begin(), page.end(), option), end; at != end; ++at)
        named.insert(at->str());
    EXPECT_GT(named.size(), 8u);
    for (const std::string& name : named)
        EXPECT_THAT(help, testing::ContainsRegex(name + "[^a-z-]")) << name; // such as --no-depth{false}
}

TEST_F(Package, IconsHaveTheirSizes) {
    for (const int size : {48, 128, 256}) {
        const std::string name = std::to_string(size) + "x" + std::to_string(size);
        EXPECT_THAT(
            run(game() + "check " + quoted(prefix() / ("share/icons/hicolor/" + name + "/apps/shoal.png")))
                .said,
            HasSubstr(name + " PNG"));
    }
    EXPECT_THAT(run(game() + "check " + quoted(prefix() / "share/games/shoal/content/icon.png")).said,
                HasSubstr("64x64 PNG"));
    EXPECT_TRUE(fs::exists(prefix() / "share/icons/hicolor/scalable/apps/shoal.svg"));
}

TEST_F(Package, DesktopEntryStartsTheGameWithAndWithoutAFile) {
    const std::string entry = text("share/applications/shoal.desktop");
    // The prefix that it was installed for; a space asks for quotes.
    const std::string program = (kScratch / "the prefix/games/shoal").string();
    EXPECT_THAT(entry, HasSubstr("\nExec=\"" + program + "\" play %f\nTryExec=" + program + "\n"));
    EXPECT_THAT(entry, HasSubstr("\nMimeType=video/mp4;"));
    if (!installed("desktop-file-validate")) GTEST_SKIP() << "needs desktop-file-utils";
    const Outcome outcome =
        run("desktop-file-validate " + quoted(prefix() / "share/applications/shoal.desktop"));
    EXPECT_EQ(outcome.status, 0) << outcome.said;
    EXPECT_EQ(outcome.said, "");
}

TEST_F(Package, AppStreamMetadataAreValid) {
    const std::string metadata = text(kMetadata);
    EXPECT_THAT(metadata, HasSubstr("<content_rating type=\"oars-1.1\">"));
    EXPECT_THAT(metadata, HasSubstr(">shoal.desktop<"));
    if (!installed("appstreamcli")) GTEST_SKIP() << "needs appstream";
    const Outcome outcome = run("appstreamcli validate --no-net " + quoted(prefix() / kMetadata));
    EXPECT_THAT(outcome.said, HasSubstr("alidation"));
    EXPECT_EQ(complaints(outcome), "");
}

TEST_F(Package, DebianFindsNoErrorInIt) {
    if (!installed("dpkg-shlibdeps")) GTEST_SKIP() << "needs dpkg-dev";
    // Compressed a little only: its size is not looked at.
    const Outcome made = run("cd " + quoted(kScratch) + " && " + SHOAL_CPACK + " --config " +
                             quoted(Path(SHOAL_BUILD) / "CPackConfig.cmake") +
                             " -D CPACK_DEBIAN_COMPRESSION_TYPE=gzip && mv shoal_*.deb shoal.deb");
    ASSERT_EQ(made.status, 0) << made.said;
    const std::string control = run("dpkg-deb -f " + quoted(kScratch / "shoal.deb")).said;
    for (const char* needed :
         {"Package: shoal\n", "Section: games\n", "libavcodec", "libopencv-imgcodecs", "libglfw3"})
        EXPECT_THAT(control, HasSubstr(needed));
    EXPECT_THAT(control, HasSubstr("Version: " + version() + "\n"));
    // Every file has the time of the release, so that equal sources give equal packages.
    std::smatch date;
    const std::string metadata = text(kMetadata);
    ASSERT_TRUE(std::regex_search(metadata, date, std::regex(" date=\"([0-9-]+)\"")));
    std::istringstream files(run("TZ=UTC dpkg-deb -c " + quoted(kScratch / "shoal.deb")).said);
    for (std::string line; std::getline(files, line);)
        EXPECT_THAT(line, HasSubstr(date[1].str() + " 00:00 ./"));
    if (!installed("lintian")) GTEST_SKIP() << "needs lintian";
    const Outcome looked =
        run("lintian --allow-root --fail-on error,warning " + quoted(kScratch / "shoal.deb"));
    EXPECT_EQ(complaints(looked), "") << looked.said;
    EXPECT_LE(looked.status, 2) << looked.said; // 2: it complained
}

// Made as by `cpack -G TXZ`, but compressed more quickly, and unpacked where a name has a space.
TEST_F(Package, ArchiveBringsItsLibrariesAndPlaysInAnyFolder) {
    if (run("grep -qx VERSION_CODENAME=bookworm /etc/os-release").status != 0)
        GTEST_SKIP() << "needs Debian 12: an archive made on it runs on newer systems too";
    if (!installed("patchelf")) GTEST_SKIP() << "needs patchelf";
    const Path folder = kScratch / "a folder";
    fs::create_directories(folder);
    const Outcome made =
        run("cd " + quoted(kScratch) + " && " + SHOAL_CPACK + " -G TGZ --config " +
            quoted(Path(SHOAL_BUILD) / "CPackConfig.cmake") + " && rm -r _CPack_Packages && tar -C " +
            quoted(folder) + " --strip-components=1 -xf shoal-*.tar.gz && rm shoal-*.tar.gz");
    ASSERT_EQ(made.status, 0) << made.said;
    uint64_t bytes = 0;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (entry.is_regular_file()) bytes += entry.file_size();
    EXPECT_LE(bytes, 250'000'000u);
    for (const char* name :
         {"README.md", "share/doc/shoal/copyright", "share/doc/shoal/libraries/SOURCES",
          "share/doc/shoal/common-licenses/GPL-3", "share/games/shoal/content/fonts/OFL.txt"})
        EXPECT_TRUE(fs::exists(folder / name)) << name;

    const std::string shoal =
                          "cd / && env -u SHOAL_DATA -u LD_LIBRARY_PATH XDG_CONFIG_HOME=" + quoted(kScratch) +
                          " LD_DEBUG_OUTPUT=" + quoted(kScratch / "loaded") + " ",
                      program = quoted(folder / "games/shoal");
    const Path picture = kScratch / "of the archive.png";
    const Outcome dive =
        run(shoal + program + " --headless --at 2 --size 64x36 --screenshot " + quoted(picture));
    EXPECT_EQ(dive.status, 0) << dive.said;
    EXPECT_TRUE(fs::exists(picture));
    EXPECT_EQ(run(shoal + program + " devices").status, 0);
    // It may load its own libraries, those of C, C++ and OpenGL, and its spare ones where a system has none.
    const std::regex system(
        ".*/(ld-linux.*|lib(c|m|dl|pthread|rt|resolv|gcc_s|stdc\\+\\+|GL.*|EGL.*)\\.so.*)");
    const Outcome checked = run(shoal + "LD_DEBUG=files " + program + " check " + quoted(picture) +
                                " && cat " + quoted(kScratch) + "/loaded.*");
    EXPECT_EQ(checked.status, 0) << checked.said;
    const std::regex line("calling init: (/.*)");
    size_t own = 0;
    for (std::sregex_iterator at(checked.said.begin(), checked.said.end(), line), end; at != end; ++at) {
        const Path file = Path(at->str(1)).lexically_normal();
        if (file.string().starts_with(folder.string()))
            ++own;
        else
            EXPECT_TRUE(std::regex_match(file.string(), system) ||
                        fs::exists(folder / "lib/games/shoal/spare" / file.filename()))
                << file;
    }
    EXPECT_GT(own, 100u);

    // A desktop replaces %k by the entry's own path, and doubles of backslashes by one.
    const Path entry = folder / "shoal.desktop";
    const std::string text = readText(entry).value();
    std::smatch exec;
    ASSERT_TRUE(std::regex_search(text, exec, std::regex("\nExec=(.*) %k play %f\n")));
    const std::string started = std::regex_replace(exec.str(1), std::regex(R"(\\\\)"), "\\");
    EXPECT_EQ(run("cd / && " + started + " " + quoted(entry) + " --version").said,
              run(game() + "--version").said);
    if (!installed("desktop-file-validate")) GTEST_SKIP() << "needs desktop-file-utils";
    EXPECT_EQ(run("desktop-file-validate " + quoted(entry)).said, "");
}

// packages_play of game/setup.
std::vector<std::string> packagesOfTheGame() {
    const std::string setup = readText(tests::sourceFolder() / "game/setup").value();
    const size_t from = setup.find("packages_play=(") + 15;
    std::istringstream words(setup.substr(from, setup.find(')', from) - from));
    return {std::istream_iterator<std::string>(words), {}};
}

TEST(Dependencies, EachIsExplained) {
    const std::string readme = readText(tests::sourceFolder() / "engine/README.md").value();
    const std::string table = readme.substr(readme.find("## Dependencies"));
    for (const std::string& package : packagesOfTheGame()) EXPECT_THAT(table, HasSubstr("`" + package + "`"));
}

TEST(Dependencies, AreInTheBillOfMaterials) {
    if (!installed("dpkg-query")) GTEST_SKIP() << "needs Debian's dpkg";
    const Path bill = kScratch / "bill.json";
    fs::create_directories(kScratch);
    const Outcome outcome = run(std::string(SHOAL_CMAKE) + " -D PROGRAMS=" + quoted(Path(tests::program())) +
                                " -D CODECS=" + quoted(Path(SHOAL_BUILD) / "game/libshoal_codecs.so") +
                                " -D VERSION=1 -D OUT=" + quoted(bill) +
                                " -D SETUP=" + quoted(tests::sourceFolder() / "game/setup") + " -P " +
                                quoted(tests::sourceFolder() / "content/package/Sbom.cmake"));
    ASSERT_EQ(outcome.status, 0) << outcome.said;
    const std::string text = readText(bill).value();
    for (const std::string& package : packagesOfTheGame())
        EXPECT_THAT(text, HasSubstr("\"" + package + "\"")) << package;
    for (const char* loaded : {"libavcodec[0-9]+", "libopencv-core[0-9]+", "libopenal1", "libc6"})
        EXPECT_THAT(text, testing::ContainsRegex(std::string("\"") + loaded + "\""));
}

} // namespace
} // namespace shoal
