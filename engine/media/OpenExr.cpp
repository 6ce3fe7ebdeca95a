#include "engine/media/OpenExr.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>
#include <ImfOutputFile.h>
#include <ImfPartType.h>
#include <ImfStandardAttributes.h>
#include <ImfStdIO.h>
#include <fmt/ranges.h>
#include <openexr.h>

#include <algorithm>
#include <cctype>
#include <functional>
#include <set>

namespace shoal::media {

namespace {

constexpr int kOnThisThread = 0;

struct Layer {
    int part = 0;
    std::string name;   // as readHdr() takes it; may be empty
    std::string prefix; // of its channels' names, with the dot; may be empty
    bool rgb = false;   // else luminance alone
    bool firstView = true;
};

// Returns the text without line breaks and commands to terminals, which names of the file may hold.
std::string printable(std::string text) {
    std::ranges::replace_if(
        text, [](unsigned char c) { return std::iscntrl(c) != 0; }, '?');
    return text;
}

// Adds the layers of a part that have colour, that of channels without a prefix first.
void addLayers(const Imf::Header& header, int part, std::vector<Layer>& layers) {
    const Imf::ChannelList& channels = header.channels();
    const Imf::StringVector views = Imf::hasMultiView(header) ? Imf::multiView(header) : Imf::StringVector();
    std::set<std::string> names;
    channels.layers(names);
    names.insert("");
    for (const std::string& name : names) {
        const std::string prefix = name.empty() ? "" : name + ".";
        const auto has = [&](const char* channel) {
            return channels.findChannel(prefix + channel) != nullptr;
        };
        Layer layer{part, name, prefix, has("R") && has("G") && has("B")};
        // X, Y and Z are a direction or a place; RY and BY are chroma.
        if (!layer.rgb && (!has("Y") || has("X") || has("RY"))) continue;
        if (name.empty() && header.hasName()) layer.name = header.name();
        const std::string last = name.substr(name.find_last_of('.') + 1); // may be a view: "diffuse.left"
        layer.firstView = views.empty() || std::find(views.begin() + 1, views.end(), last) == views.end();
        layers.push_back(layer);
    }
}

// Returns the layer of this name. Without a name, returns the channels without a prefix, or else the only
// layer, of the first part and view with colour.
Result<Layer> chooseLayer(std::vector<Layer> layers, const std::string& wanted) {
    std::vector<std::string> names;
    for (const Layer& layer : layers)
        if (!layer.name.empty()) names.push_back(layer.name);
    const std::string all = printable(fmt::format("{}", fmt::join(names, ", ")));
    if (!wanted.empty()) {
        const auto named = std::ranges::find(layers, wanted, &Layer::name);
        if (named != layers.end()) return *named;
        return Error{"", fmt::format("has no colour in a layer \"{}\", but in: {}", wanted,
                                     all.empty() ? "channels without a layer" : all)};
    }
    const auto prefer = [&](auto&& better) {
        if (std::ranges::any_of(layers, better)) std::erase_if(layers, std::not_fn(better));
    };
    prefer([](const Layer& layer) { return layer.rgb; });
    prefer([first = layers.front().part](const Layer& layer) { return layer.part == first; });
    prefer([](const Layer& layer) { return layer.firstView; });
    if (layers.size() == 1 || layers.front().prefix.empty()) return layers.front();
    return Error{"", fmt::format("has several layers; name one by --layer: {}", all)};
}

PictureSize sizeOf(const Imath::Box2i& window) {
    return {int64_t{window.max.x} - window.min.x + 1, int64_t{window.max.y} - window.min.y + 1};
}

// Returns a black image of the window's size, which must be within limits.
ImageRgbF imageOf(const Imath::Box2i& window) {
    return {static_cast<int>(sizeOf(window).width), static_cast<int>(sizeOf(window).height)};
}

// Returns why a part cannot be read; empty if it can.
std::string refusalOf(const Imf::Header& header, PictureLimits limits) {
    for (const Imath::Box2i& window : {header.displayWindow(), header.dataWindow()})
        if (const std::string refusal = beyond(sizeOf(window), limits); !refusal.empty()) return refusal;
    if (Imf::hasEnvmap(header) && Imf::envmap(header) == Imf::ENVMAP_CUBE)
        return "is a cube map; only lat-long pictures can be shown, so convert it";
    // The library takes memory for all channels of a tile, or of a block of at most 256 rows. It may take as
    // much as the largest picture does, or 64 MiB.
    const int64_t most = std::max<int64_t>(int64_t{limits.maxWidth} * limits.maxHeight * 3, 1 << 24);
    int64_t width = sizeOf(header.dataWindow()).width, height = 256, channels = 0;
    for (auto at = header.channels().begin(); at != header.channels().end(); ++at) ++channels;
    if (header.hasTileDescription()) {
        width = std::max<int64_t>(width, header.tileDescription().xSize);
        height = std::max<int64_t>(height, header.tileDescription().ySize);
    }
    if (width > most / height / std::max<int64_t>(channels, 1))
        return fmt::format("its {} channels take more memory than the limit", channels);
    return "";
}

// Returns the pixels of the data window for a layer of RGB or of luminance alone.
ImageRgbF readChannels(Imf::MultiPartInputFile& file, const Layer& layer) {
    Imf::InputPart input(file, layer.part);
    const Imath::Box2i window = input.header().dataWindow();
    ImageRgbF image = imageOf(window);
    constexpr size_t kPixel = 3 * sizeof(float);
    Imf::FrameBuffer buffer;
    for (const auto& [channel, offset] : {std::pair(layer.rgb ? "R" : "Y", 0), {"G", 1}, {"B", 2}})
        if (layer.rgb || offset == 0)
            buffer.insert(layer.prefix + channel,
                          Imf::Slice::Make(Imf::FLOAT, image.pixels.data() + offset, window, kPixel,
                                           kPixel * static_cast<size_t>(image.width)));
    input.setFrameBuffer(buffer);
    input.readPixels(window.min.y, window.max.y);
    for (size_t i = 0; !layer.rgb && i < image.pixels.size(); i += 3)
        image.pixels[i + 1] = image.pixels[i + 2] = image.pixels[i];
    return image;
}

// Returns the display window's picture, black outside of the data window.
ImageRgbF placed(ImageRgbF pixels, const Imath::Box2i& data, const Imath::Box2i& display) {
    if (data == display) return pixels;
    ImageRgbF image = imageOf(display);
    const int left = std::max(display.min.x, data.min.x), right = std::min(display.max.x, data.max.x);
    for (int y = std::max(display.min.y, data.min.y); y <= std::min(display.max.y, data.max.y); ++y)
        if (left <= right)
            std::copy(pixels.at(left - data.min.x, y - data.min.y),
                      pixels.at(right - data.min.x, y - data.min.y) + 3,
                      image.at(left - display.min.x, y - display.min.y));
    return image;
}

// Returns a clause for each way in which the picture of this layer differs from the whole file.
std::vector<std::string> notesOn(const Imf::MultiPartInputFile& file, const Layer& layer) {
    const Imf::Header& header = file.header(layer.part);
    std::vector<std::string> notes;
    if (!layer.rgb) notes.emplace_back("grey");
    if (file.parts() > 1) notes.push_back(fmt::format("part {} of {}", layer.part + 1, file.parts()));
    if (!layer.name.empty()) notes.push_back(fmt::format("layer {}", layer.name));
    if (header.hasView()) notes.push_back(fmt::format("view {}", header.view()));
    if (Imf::hasMultiView(header))
        notes.push_back(fmt::format("of the views {}", fmt::join(Imf::multiView(header), ", ")));
    const Imath::Box2i data = header.dataWindow(), display = header.displayWindow();
    if (data != display) {
        const PictureSize size = sizeOf(data);
        notes.push_back(fmt::format("data of {}x{} at {}, {}, black outside", size.width, size.height,
                                    int64_t{data.min.x} - display.min.x,
                                    int64_t{data.min.y} - display.min.y));
    }
    if (header.pixelAspectRatio() != 1) notes.emplace_back("its pixels count as square");
    std::ranges::transform(notes, notes.begin(), printable);
    return notes;
}

// Returns whether OpenEXRCore reads the headers without an error. Its parser compares each stated size with
// the file's and its type's, where the classes of C++ take memory for any. It reports attributes of a wrong
// size to the handler alone, and leaves them out.
bool hasSoundHeaders(const Path& file) {
    bool sound = true;
    exr_context_initializer_t setup = EXR_DEFAULT_CONTEXT_INITIALIZER;
    setup.user_data = &sound;
    setup.error_handler_fn = [](exr_const_context_t context, exr_result_t, const char*) {
        void* found = nullptr;
        if (exr_get_user_data(context, &found) == EXR_ERR_SUCCESS) *static_cast<bool*>(found) = false;
    };
    exr_context_t context = nullptr;
    const bool read = exr_start_read(&context, file.c_str(), &setup) == EXR_ERR_SUCCESS;
    exr_finish(&context);
    return read && sound;
}

// Returns whether each list of channels ends where its size says. OpenEXRCore reads so far, where the classes
// of C++ read on to the empty name that ends a list, and may take the rest for attributes. A header is a
// sequence of name, type, size and value, ended by an empty name (OpenEXR File Layout).
bool listsEnd(ByteSpan file) {
    size_t at = 8; // behind magic number and version
    const auto text = [&] {
        const size_t begin = at;
        while (at < file.size() && file[at]) ++at;
        return asText(file.subspan(std::min(begin, file.size()), at++ - begin));
    };
    constexpr uint8_t kSeveralParts = 0x10; // of the second byte of the version
    do {
        while (!text().empty()) {
            const bool channels = text() == "chlist";
            if (at + 4 > file.size() || little32(file, at) > file.size() - at - 4) return false;
            const size_t end = at + 4 + little32(file, at);
            at += 4;
            while (channels && at < end && file[at]) text(), at += 16;
            if (channels && at + 1 != end) return false;
            at = end;
        }
    } while (file.size() > 8 && (file[5] & kSeveralParts) && at < file.size() && file[at]);
    return true;
}

} // namespace

Result<HdrPicture> decodeExr(const Path& name, ByteSpan bytes, const std::string& wanted,
                             PictureLimits limits) try {
    if (!hasSoundHeaders(name) || !listsEnd(bytes))
        return Error{"", "its header is damaged, cut short or of an unread variant"};
    Imf::MultiPartInputFile file(name.c_str(), kOnThisThread);
    std::vector<Layer> layers;
    std::string deep;
    for (int part = 0; part < file.parts(); ++part) {
        const Imf::Header& header = file.header(part);
        if (header.hasType() && Imf::isDeepData(header.type()))
            deep = printable(
                fmt::format("its part \"{}\" is deep; flatten it", header.hasName() ? header.name() : ""));
        else
            addLayers(header, part, layers);
    }
    if (layers.empty())
        return Error{"", deep.empty() ? "has no colour: neither channels R, G and B nor Y alone" : deep};
    const auto layer = chooseLayer(std::move(layers), wanted);
    if (!layer) return layer.error();
    const Imf::Header& header = file.header(layer->part);
    if (std::string refusal = refusalOf(header, limits); !refusal.empty())
        return Error{"", std::move(refusal)};
    if (!file.partComplete(layer->part)) return Error{"", "is cut short"};

    HdrPicture picture{.radianceLin =
                           placed(readChannels(file, *layer), header.dataWindow(), header.displayWindow()),
                       .notes = notesOn(file, *layer)};
    if (Imf::hasChromaticities(header) && layer->rgb) {
        const Imf::Chromaticities& c = Imf::chromaticities(header);
        picture.primaries = {c.red.x,  c.red.y,  c.green.x, c.green.y,
                             c.blue.x, c.blue.y, c.white.x, c.white.y};
    }
    return picture;
} catch (const std::exception&) {
    return Error{"", "cannot be decoded as OpenEXR: cut short, damaged, or a rare variant"};
}

Result<std::string> encodeExr(const ImageRgbF& image) try {
    Imf::Header header(image.width, image.height);
    Imf::FrameBuffer buffer;
    for (const auto& [name, offset] : {std::pair("R", 0), {"G", 1}, {"B", 2}}) {
        header.channels().insert(name, Imf::Channel(Imf::FLOAT));
        buffer.insert(name, Imf::Slice::Make(Imf::FLOAT, image.pixels.data() + offset, header.dataWindow(),
                                             3 * sizeof(float),
                                             3 * sizeof(float) * static_cast<size_t>(image.width)));
    }
    Imf::StdOSStream stream;
    {
        Imf::OutputFile output(stream, header, kOnThisThread); // its end writes the table of rows
        output.setFrameBuffer(buffer);
        output.writePixels(image.height);
    }
    return stream.str();
} catch (const std::exception&) {
    return Error{"", "the picture cannot be coded as OpenEXR"};
}

bool toRec709(ImageRgbF& image, const Primaries& from) try {
    const Imf::Chromaticities ours;
    const Imf::Chromaticities theirs({from[0], from[1]}, {from[2], from[3]}, {from[4], from[5]},
                                     {from[6], from[7]});
    // Lam, "Metamerism and Colour Constancy", 1985: XYZ to cones, transposed, as Imath's vectors are rows.
    const Imath::M44f toCones(0.8951f, -0.7502f, 0.0389f, 0, 0.2664f, 1.7135f, -0.0685f, 0, -0.1614f, 0.0367f,
                              1.0296f, 0, 0, 0, 0, 1);
    const Imath::M44f toXyz = Imf::RGBtoXYZ(theirs, 1);
    const Imath::V3f white(1), there = white * toXyz * toCones,
                               here = white * Imf::RGBtoXYZ(ours, 1) * toCones;
    const Imath::M44f matrix =
        toXyz * toCones * Imath::M44f().setScale(here / there) * toCones.inverse() * Imf::XYZtoRGB(ours, 1);
    if (const Imath::V3f grey = white * matrix; !grey.equalWithAbsError(white, 1e-3f)) return false;
    for (size_t i = 0; i < image.pixels.size(); i += 3) {
        float* p = image.pixels.data() + i;
        const Imath::V3f colour = Imath::V3f(p[0], p[1], p[2]) * matrix;
        for (int c = 0; c < 3; ++c) p[c] = colour[c] > 0 ? std::min(colour[c], kMaxRadiance) : 0;
    }
    return true;
} catch (const std::exception&) {
    return false;
}

} // namespace shoal::media
