// OpenEXR pictures as renderers and editors write them, made by OpenEXR's own library.
#include "engine/media/Check.h"
#include "tests/unit/media/TestFiles.h"

#include <ImfChannelList.h>
#include <ImfDeepScanLineOutputFile.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfOutputPart.h>
#include <ImfPartType.h>
#include <ImfStandardAttributes.h>
#include <fmt/core.h>

namespace shoal::media {
namespace {

using testing::HasSubstr;

struct Part {
    std::map<std::string, float> channels; // their values at the display window's corner
    std::string name = "";
    Imf::Header header = Imf::Header(4, 2);
};
const Part kRgb = {{{"R", 1}, {"G", 2}, {"B", 3}}};

// Returns channels of one layer, values from `first` on.
std::map<std::string, float> rgb(const std::string& layer, float first) {
    return {{layer + ".R", first}, {layer + ".G", first + 1}, {layer + ".B", first + 2}};
}

std::map<std::string, float> both(std::map<std::string, float> a, const std::map<std::string, float>& b) {
    return a.insert(b.begin(), b.end()), a;
}

class OpenExr : public testing::Test {
  protected:
    const TempFolder folder;
    const Path file = folder / "a.exr";

    // Writes floats that grow by 1 from column to column and by 10 from row to row.
    void write(std::vector<Part> parts) {
        std::vector<Imf::Header> headers;
        for (Part& part : parts) {
            for (const auto& [name, value] : part.channels)
                part.header.channels().insert(name, Imf::Channel(Imf::FLOAT));
            part.header.setType(Imf::SCANLINEIMAGE);
            if (!part.name.empty()) part.header.setName(part.name);
            headers.push_back(part.header);
        }
        Imf::MultiPartOutputFile out(file.c_str(), headers.data(), static_cast<int>(headers.size()));
        for (size_t i = 0; i < parts.size(); ++i) {
            const Imath::Box2i window = parts[i].header.dataWindow();
            std::map<std::string, std::vector<float>> pixels;
            Imf::FrameBuffer buffer;
            for (const auto& [name, value] : parts[i].channels) {
                for (int y = window.min.y; y <= window.max.y; ++y)
                    for (int x = window.min.x; x <= window.max.x; ++x)
                        pixels[name].push_back(value + static_cast<float>(x + 10 * y));
                buffer.insert(name, Imf::Slice::Make(Imf::FLOAT, pixels[name].data(), window));
            }
            Imf::OutputPart part(out, static_cast<int>(i));
            part.setFrameBuffer(buffer);
            part.writePixels(window.max.y - window.min.y + 1);
        }
    }

    // Returns the corner's colour and the notes, or the reason against it.
    std::string read(const std::string& layer = "") const {
        const auto picture = readHdr(file, {}, layer);
        if (!picture) return picture.error().reason;
        const float* p = picture->radianceLin.at(0, 0);
        std::string said = fmt::format("{:.3g} {:.3g} {:.3g}", p[0], p[1], p[2]);
        for (const std::string& note : picture->notes) said += "; " + note;
        return said;
    }
};

TEST_F(OpenExr, LayersPartsAndViewsAreChosen) {
    Imf::Header views(4, 2), cube(4, 2), wide(4, 2);
    Imf::addMultiView(views, {"left", "right"});
    Imf::addEnvmap(cube, Imf::ENVMAP_CUBE);
    wide.pixelAspectRatio() = 2;
    const auto expect = [&](const std::vector<Part>& parts, const char* layer, const std::string& said) {
        write(parts);
        EXPECT_EQ(read(layer), said);
    };
    expect({kRgb}, "", "1 2 3");
    expect({kRgb}, "x", "has no colour in a layer \"x\", but in: channels without a layer");
    expect({{{{"Y", 5}}}}, "", "5 5 5; grey");
    for (const auto& channels : {std::map<std::string, float>{{"Z", 5}}, {{"Y", 5}, {"RY", 0}, {"BY", 0}}})
        expect({{channels}}, "", "has no colour: neither channels R, G and B nor Y alone");
    expect({{both(rgb("View.Combined", 4), {{"View.Mist.Z", 0}})}}, "", "4 5 6; layer View.Combined");
    const std::vector<Part> two = {{both(rgb("a", 4), rgb("b\n", 7))}};
    expect(two, "", "has several layers; name one by --layer: a, b?");
    expect(two, "a", "4 5 6; layer a");
    EXPECT_THAT(checkMedia(file, "a")->c_str(), HasSubstr("; layer a"));
    expect(two, "c", "has no colour in a layer \"c\", but in: a, b?");
    expect({{both(kRgb.channels, rgb("a", 4))}}, "", "1 2 3");
    const std::vector<Part> eyes = {{both(kRgb.channels, rgb("right", 4)), "", views}};
    expect(eyes, "", "1 2 3; of the views left, right");
    expect(eyes, "right", "4 5 6; layer right; of the views left, right");
    expect({{both(rgb("a.right", 4), rgb("a.left", 7)), "", views}}, "",
           "7 8 9; layer a.left; of the views left, right");
    const std::vector<Part> parts = {
        {{{"Z", 0}}, "depth"}, {kRgb.channels, "beauty"}, {rgb("o", 4), "other"}};
    expect(parts, "", "1 2 3; part 2 of 3; layer beauty");
    expect(parts, "o", "4 5 6; part 3 of 3; layer o");
    expect({{kRgb.channels, "", cube}}, "",
           "is a cube map; only lat-long pictures can be shown, so convert it");
    expect({{kRgb.channels, "", wide}}, "", "1 2 3; its pixels count as square");
    EXPECT_THAT(checkPicture(file)->c_str(), HasSubstr("mono by its shape; its pixels count as square"));
}

TEST_F(OpenExr, TheDisplayWindowIsThePictureAndTheDataWindowIsBounded) {
    Part part = kRgb;
    part.header.dataWindow() = {{2, -1}, {5, 0}}; // over the right and the upper edge
    write({part});
    EXPECT_THAT(read(), HasSubstr("0 0 0; data of 4x2 at 2, -1, black outside"));
    const auto picture = tests::valueOf(readHdr(file));
    EXPECT_EQ(picture.radianceLin.pixels, (std::vector<float>{0, 0, 0, 0, 0, 0, 3, 4, 5, 4, 5, 6, //
                                                              0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}));
    part.header.dataWindow() = {{0, 0}, {4, 1}};
    write({part});
    EXPECT_FALSE(readHdr(file, {4, 2}));
    EXPECT_TRUE(readHdr(file, {5, 2}));
    part.header.dataWindow() = {{7, 7}, {8, 8}}; // beside it
    write({part});
    EXPECT_EQ(tests::valueOf(readHdr(file)).radianceLin.pixels, std::vector<float>(24, 0));
}

// The matrix of ACES2065-1 to Rec. 709 by Bradford's adaptation is that of OpenColorIO 2.
TEST_F(OpenExr, PrimariesBecomeThoseOfRec709AndWhiteStaysWhite) {
    Part part = {{{"R", 0.3f}, {"G", 0.4f}, {"B", 0.5f}}};
    Imf::addChromaticities(part.header,
                           {{0.7347f, 0.2653f}, {0, 1}, {0.0001f, -0.077f}, {0.32168f, 0.33767f}});
    write({part});
    EXPECT_EQ(read(), "0.109 0.418 0.518; converted to the primaries of Rec. 709");
    part.channels = {{"R", 1}, {"G", 1}, {"B", 1}};
    write({part});
    EXPECT_EQ(read(), "1 1 1; converted to the primaries of Rec. 709");
    part.channels = {{"R", 0}, {"G", 1}, {"B", 0}}; // beyond Rec. 709, which is no fault of the file
    write({part});
    EXPECT_EQ(read(), "0 1.37 0; converted to the primaries of Rec. 709");
    Imf::addChromaticities(part.header, {{0.3f, 0.3f}, {0.3f, 0.3f}, {0.3f, 0.3f}, {0.3f, 0.3f}});
    write({part});
    EXPECT_EQ(read(), "0 1 0; its primaries span no colours and count as those of Rec. 709");
}

TEST_F(OpenExr, DeepPartsAreRefusedByName) {
    Imf::Header header(4, 2);
    header.setType(Imf::DEEPSCANLINE);
    header.setName("fog");
    header.compression() = Imf::ZIPS_COMPRESSION;
    header.channels().insert("R", Imf::Channel(Imf::FLOAT));
    { Imf::DeepScanLineOutputFile out(file.c_str(), header); }
    EXPECT_EQ(read(), "its part \"fog\" is deep; flatten it");
}

// All of one panorama: shared/data/README.md.
TEST_F(OpenExr, FilesOfPeopleShowTheSamePanorama) {
    const Path reference = sharedData("files/std.exr");
    if (reference.empty()) GTEST_SKIP() << "no shared files/std.exr";
    const std::vector<float> wanted = tests::valueOf(readHdr(reference)).radianceLin.pixels;
    const struct {
        const char* name;
        float factor, share; // tolerance relative to a pixel's largest component: RGBE's mantissas are cut
    } kFiles[] = {{"blender.exr", 1, 0},   {"multiview.exr", 1, 0},     {"crlf.pfm", 1, 0},
                  {"yonly.exr", 1, 2e-3f}, {"crlf.hdr", 1, 1 / 128.0f}, {"exposure.hdr", 0.25f, 1 / 128.0f}};
    for (const auto& each : kFiles) {
        const auto got = tests::valueOf(readHdr(reference.parent_path() / each.name)).radianceLin.pixels;
        ASSERT_EQ(got.size(), wanted.size()) << each.name;
        for (size_t i = 0; i < wanted.size(); ++i) {
            const float* p = &wanted[i - i % 3];
            const float grey = 0.2126f * p[0] + 0.7152f * p[1] + 0.0722f * p[2];
            const float right = std::string_view(each.name) == "yonly.exr" ? grey : wanted[i];
            ASSERT_NEAR(got[i], right * each.factor, each.share * std::max({p[0], p[1], p[2]})) << each.name;
        }
    }
}

// Found by tests/fuzz: OpenEXR allocated gigabytes for a size in a field that we had not checked.
TEST_F(OpenExr, SizesAreCheckedBeforeTheLibraryBelievesThem) {
    const Path found = tests::sourceFolder() / "tests/fuzz/regressions/Pictures";
    for (const char* name : {"exr_attribute_size", "exr_list_shorter_than_stated", "exr_list_without_end",
                             "exr_unknown_attribute_size"})
        EXPECT_THAT(tests::errorOf(readHdr(found / name, {2048, 2048})).reason,
                    HasSubstr("header is damaged"))
            << name;
}

} // namespace
} // namespace shoal::media
