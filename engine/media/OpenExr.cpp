#include "engine/media/OpenExr.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>
#include <ImfMultiView.h>
#include <ImfOutputFile.h>
#include <ImfPartType.h>
#include <ImfRgbaFile.h>
#include <ImfStandardAttributes.h>
#include <fmt/ranges.h>
#include <openexr.h>

#include <algorithm>
#include <set>
#include <stdexcept>

namespace shoal::media {

namespace {

constexpr int kOnThisThread = 0;

class ExrInput : public Imf::IStream {
  public:
    explicit ExrInput(ByteSpan bytes) : IStream("picture"), bytes_(bytes) {}
    bool read(char out[], int count) override {
        if (count < 0 || at_ > bytes_.size() || bytes_.size() - at_ < static_cast<size_t>(count))
            throw std::runtime_error("the bytes end");
        std::memcpy(out, bytes_.data() + at_, static_cast<size_t>(count));
        at_ += static_cast<size_t>(count);
        return at_ < bytes_.size();
    }
    uint64_t tellg() override { return at_; }
    void seekg(uint64_t position) override { at_ = position; }

  private:
    ByteSpan bytes_;
    uint64_t at_ = 0;
};

class ExrOutput : public Imf::OStream {
  public:
    ExrOutput() : OStream("picture") {}
    void write(const char text[], int count) override {
        const auto size = static_cast<size_t>(count);
        if (bytes.size() < at_ + size) bytes.resize(at_ + size);
        bytes.replace(at_, size, text, size);
        at_ += size;
    }
    uint64_t tellp() override { return at_; }
    void seekp(uint64_t position) override { at_ = position; }

    std::string bytes;

  private:
    uint64_t at_ = 0;
};

struct Layer {
    int part = 0;
    std::string name;   // as readHdr() takes it; may be empty
    std::string prefix; // of its channels' names, with the dot; may be empty
    bool rgb = false;
    bool chroma = false; // neither: luminance alone
    bool firstView = true;
};

// Returns the layers of a flat part that have colour, that of channels without a prefix first.
std::vector<Layer> layersOf(const Imf::Header& header, int part) {
    const Imf::ChannelList& channels = header.channels();
    std::set<std::string> names;
    channels.layers(names);
    names.insert("");
    std::vector<Layer> layers;
    for (const std::string& name : names) {
        const std::string prefix = name.empty() ? "" : name + ".";
        const auto has = [&](const char* channel) {
            return channels.findChannel(prefix + channel) != nullptr;
        };
        Layer layer{part, name, prefix, has("R") && has("G") && has("B"), has("RY") && has("BY")};
        if (!layer.rgb && !has("Y")) continue;
        if (name.empty() && header.hasName()) layer.name = header.name();
        if (Imf::hasMultiView(header)) {
            const Imf::StringVector& views = Imf::multiView(header);
            const std::string view = Imf::viewFromChannelName(prefix + (layer.rgb ? "R" : "Y"), views);
            layer.firstView = view.empty() || view == Imf::defaultViewName(views);
        }
        layers.push_back(layer);
    }
    return layers;
}

Result<Layer> chooseLayer(const Imf::MultiPartInputFile& file, const std::string& wanted) {
    std::vector<Layer> layers;
    std::vector<std::string> names;
    std::string deep;
    for (int part = 0; part < file.parts(); ++part) {
        const Imf::Header& header = file.header(part);
        if (header.hasType() && Imf::isDeepData(header.type())) {
            deep = fmt::format("its part \"{}\" is deep; flatten it", header.hasName() ? header.name() : "");
            continue;
        }
        for (Layer& layer : layersOf(header, part)) {
            if (!layer.name.empty()) names.push_back(layer.name);
            layers.push_back(std::move(layer));
        }
    }
    if (layers.empty())
        return Error{"", deep.empty() ? "has no colour: neither channels R, G and B nor Y" : deep};
    if (!wanted.empty()) {
        const auto named = std::ranges::find(layers, wanted, &Layer::name);
        if (named != layers.end()) return *named;
        return Error{"", fmt::format("has no layer \"{}\" with colour{}{}", wanted,
                                     names.empty() ? "" : "; it has ", fmt::join(names, ", "))};
    }
    const auto keep = [&](auto&& better) { // drops the others, unless all are
        if (std::ranges::any_of(layers, better))
            std::erase_if(layers, [&](const Layer& layer) { return !better(layer); });
    };
    keep([](const Layer& layer) { return layer.rgb || layer.chroma; });
    keep([first = layers.front().part](const Layer& layer) { return layer.part == first; });
    keep([](const Layer& layer) { return layer.firstView; });
    if (layers.size() == 1 || layers.front().prefix.empty()) return layers.front();
    return Error{"", fmt::format("has several layers; name one by --layer: {}", fmt::join(names, ", "))};
}

PictureSize sizeOf(const Imath::Box2i& window) {
    return {int64_t{window.max.x} - window.min.x + 1, int64_t{window.max.y} - window.min.y + 1};
}

// Returns why a part cannot be read; empty if it can.
std::string refusalOf(const Imf::Header& header, PictureLimits limits) {
    for (const Imath::Box2i& window : {header.displayWindow(), header.dataWindow()})
        if (const std::string refusal = beyond(sizeOf(window), limits); !refusal.empty()) return refusal;
    if (Imf::hasEnvmap(header) && Imf::envmap(header) == Imf::ENVMAP_CUBE)
        return "is a cube map; only lat-long pictures can be shown, so convert it";
    // The library takes memory for all channels of a tile, or of a block of at most 256 rows.
    constexpr int64_t kMaxBlock = int64_t{2} << 30;
    int64_t width = sizeOf(header.dataWindow()).width, height = 256, channels = 0;
    for (auto at = header.channels().begin(); at != header.channels().end(); ++at) ++channels;
    if (header.hasTileDescription()) {
        width = std::max<int64_t>(width, header.tileDescription().xSize);
        height = std::max<int64_t>(height, header.tileDescription().ySize);
    }
    if (width > kMaxBlock / 4 / height / std::max<int64_t>(channels, 1))
        return fmt::format("its {} channels take more memory than the limit", channels);
    return "";
}

// Returns the address that the pixel of column 0 would have. It may lie outside of the line.
template <class T> T* columnZero(std::vector<T>& line, int firstColumn, int channels) {
    return reinterpret_cast<T*>(reinterpret_cast<intptr_t>(line.data()) -
                                intptr_t{firstColumn} * channels * static_cast<intptr_t>(sizeof(T)));
}

// Calls read(y) for each row that both windows have, then pixel(column) for each column, red first.
template <class Read, class Pixel>
void copyRows(const Imf::Header& header, ImageRgbF& image, Read&& read, Pixel&& pixel) {
    const Imath::Box2i display = header.displayWindow(), data = header.dataWindow();
    const int first = std::max(display.min.x, data.min.x), last = std::min(display.max.x, data.max.x);
    for (int y = std::max(display.min.y, data.min.y); y <= std::min(display.max.y, data.max.y); ++y) {
        read(y);
        for (int x = first; x <= last; ++x) {
            const std::array<float, 3> colour = pixel(static_cast<size_t>(x - data.min.x));
            std::ranges::copy(colour, image.at(x - display.min.x, y - display.min.y));
        }
    }
}

// Fills the image with a layer of RGB or of luminance alone.
void readChannels(Imf::MultiPartInputFile& file, const Layer& layer, ImageRgbF& image) {
    Imf::InputPart input(file, layer.part);
    const Imath::Box2i data = input.header().dataWindow();
    std::vector<float> line(static_cast<size_t>(sizeOf(data).width) * 3);
    float* base = columnZero(line, data.min.x, 3);
    Imf::FrameBuffer buffer;
    const auto add = [&](const char* channel, int offset) {
        buffer.insert(layer.prefix + channel, Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(base + offset),
                                                         3 * sizeof(float), 0)); // one line for all rows
    };
    if (layer.rgb) {
        add("R", 0);
        add("G", 1);
        add("B", 2);
    } else {
        add("Y", 0);
    }
    input.setFrameBuffer(buffer);
    const size_t g = layer.rgb ? 1 : 0, b = 2 * g;
    copyRows(
        input.header(), image, [&](int y) { input.readPixels(y); },
        [&](size_t x) {
            return std::array{line[3 * x], line[3 * x + g], line[3 * x + b]};
        });
}

// As readChannels(), for a layer of luminance and chroma in the first part. The library converts in 16 bits.
void readChroma(ByteSpan bytes, const Layer& layer, ImageRgbF& image) {
    ExrInput stream(bytes);
    Imf::RgbaInputFile input(stream, layer.prefix.substr(0, layer.prefix.size() - !layer.prefix.empty()),
                             kOnThisThread);
    const Imath::Box2i data = input.dataWindow();
    std::vector<Imf::Rgba> line(static_cast<size_t>(sizeOf(data).width));
    input.setFrameBuffer(columnZero(line, data.min.x, 1), 1, 0);
    copyRows(
        input.header(), image, [&](int y) { input.readPixels(y); },
        [&](size_t x) {
            return std::array<float, 3>{line[x].r, line[x].g, line[x].b};
        });
}

// Returns a clause for each thing that a viewer of the whole file would not expect.
std::vector<std::string> notesOn(const Imf::MultiPartInputFile& file, const Layer& layer) {
    const Imf::Header& header = file.header(layer.part);
    std::vector<std::string> notes;
    if (!layer.rgb) notes.push_back(layer.chroma ? "from luminance and chroma" : "grey");
    if (file.parts() > 1) notes.push_back(fmt::format("part {} of {}", layer.part + 1, file.parts()));
    if (!layer.name.empty()) notes.push_back("layer " + layer.name);
    if (header.hasView()) notes.push_back("view " + header.view());
    if (Imf::hasMultiView(header))
        notes.push_back(fmt::format("of the views {}", fmt::join(Imf::multiView(header), ", ")));
    const Imath::Box2i data = header.dataWindow(), display = header.displayWindow();
    if (data != display) {
        const PictureSize size = sizeOf(data);
        notes.push_back(fmt::format("data of {}x{} at {}, {}, black outside", size.width, size.height,
                                    int64_t{data.min.x} - display.min.x,
                                    int64_t{data.min.y} - display.min.y));
    }
    if (header.pixelAspectRatio() != 1) notes.push_back("its pixels count as square");
    return notes;
}

Result<HdrPicture> decodeLayer(ByteSpan bytes, const std::string& wanted, PictureLimits limits) {
    ExrInput stream(bytes);
    Imf::MultiPartInputFile file(stream, kOnThisThread);
    const auto layer = chooseLayer(file, wanted);
    if (!layer) return layer.error();
    const Imf::Header& header = file.header(layer->part);
    if (std::string refusal = refusalOf(header, limits); !refusal.empty())
        return Error{"", std::move(refusal)};
    if (!file.partComplete(layer->part)) return Error{"", "is cut short"};
    const bool converts = !layer->rgb && layer->chroma;
    if (converts && layer->part > 0)
        return Error{"", "has luminance and chroma in a part that is not the first; convert it to RGB"};

    HdrPicture picture;
    const PictureSize size = sizeOf(header.displayWindow());
    picture.radianceLin = ImageRgbF(static_cast<int>(size.width), static_cast<int>(size.height));
    if (converts)
        readChroma(bytes, *layer, picture.radianceLin);
    else
        readChannels(file, *layer, picture.radianceLin);
    picture.notes = notesOn(file, *layer);
    if (Imf::hasChromaticities(header) && (layer->rgb || layer->chroma)) {
        const Imf::Chromaticities& c = Imf::chromaticities(header);
        picture.primaries = {c.red.x,  c.red.y,  c.green.x, c.green.y,
                             c.blue.x, c.blue.y, c.white.x, c.white.y};
    }
    return picture;
}

} // namespace

// OpenEXRCore's parser compares each stated size with the file's and its type's, where the classes of C++
// take memory for any.
PictureSize exrSize(ByteSpan bytes) {
    exr_context_initializer_t setup = EXR_DEFAULT_CONTEXT_INITIALIZER;
    setup.user_data = &bytes;
    setup.error_handler_fn = [](exr_const_context_t, exr_result_t, const char*) {};
    setup.size_fn = [](exr_const_context_t, void* all) {
        return static_cast<int64_t>(static_cast<const ByteSpan*>(all)->size());
    };
    setup.read_fn = [](exr_const_context_t, void* all, void* out, uint64_t count, uint64_t at,
                       exr_stream_error_func_ptr_t) -> int64_t {
        const ByteSpan from = *static_cast<const ByteSpan*>(all);
        const size_t there = at < from.size() ? std::min<size_t>(count, from.size() - at) : 0;
        if (there > 0) std::memcpy(out, from.data() + at, there);
        return static_cast<int64_t>(there);
    };
    exr_context_t context = nullptr;
    exr_attr_box2i_t window{};
    const bool read = exr_start_read(&context, "picture", &setup) == EXR_ERR_SUCCESS &&
                      exr_get_display_window(context, 0, &window) == EXR_ERR_SUCCESS;
    exr_finish(&context);
    if (!read) return {};
    return {int64_t{window.max.x} - window.min.x + 1, int64_t{window.max.y} - window.min.y + 1};
}

Result<HdrPicture> decodeExr(ByteSpan bytes, const std::string& layer, PictureLimits limits) {
    try {
        return decodeLayer(bytes, layer, limits);
    } catch (const std::exception&) {
        return Error{"", "cannot be decoded as OpenEXR: cut short, damaged, or a rare variant"};
    }
}

Result<std::string> encodeExr(const ImageRgbF& image) {
    try {
        Imf::Header header(image.width, image.height);
        Imf::FrameBuffer buffer;
        for (const auto& [name, offset] : {std::pair("R", 0), {"G", 1}, {"B", 2}}) {
            header.channels().insert(name, Imf::Channel(Imf::FLOAT));
            auto* first = reinterpret_cast<char*>(const_cast<float*>(image.pixels.data() + offset));
            buffer.insert(name, Imf::Slice(Imf::FLOAT, first, 3 * sizeof(float),
                                           3 * sizeof(float) * static_cast<size_t>(image.width)));
        }
        ExrOutput stream;
        {
            Imf::OutputFile output(stream, header, kOnThisThread); // its end writes the table of rows
            output.setFrameBuffer(buffer);
            output.writePixels(image.height);
        }
        return std::move(stream.bytes);
    } catch (const std::exception&) {
        return Error{"", "the picture cannot be coded as OpenEXR"};
    }
}

bool toRec709(ImageRgbF& image, const Primaries& from) {
    const Imf::Chromaticities ours;
    const Imf::Chromaticities theirs({from[0], from[1]}, {from[2], from[3]}, {from[4], from[5]},
                                     {from[6], from[7]});
    // Lam, "Metamerism and Colour Constancy", 1985: XYZ to cones. Rows are XYZ, as Imath's vectors stand
    // left.
    const Imath::M44f toCones(0.8951f, -0.7502f, 0.0389f, 0, 0.2664f, 1.7135f, -0.0685f, 0, -0.1614f, 0.0367f,
                              1.0296f, 0, 0, 0, 0, 1);
    try {
        const Imath::M44f toXyz = Imf::RGBtoXYZ(theirs, 1);
        const Imath::V3f white(1), there = white * toXyz * toCones,
                                   here = white * Imf::RGBtoXYZ(ours, 1) * toCones;
        const Imath::M44f matrix = toXyz * toCones * Imath::M44f().setScale(here / there) *
                                   toCones.inverse() * Imf::XYZtoRGB(ours, 1);
        if (const Imath::V3f grey = white * matrix; !grey.equalWithAbsError(white, 1e-3f)) return false;
        for (size_t i = 0; i < image.pixels.size(); i += 3) {
            float* p = image.pixels.data() + i;
            const Imath::V3f colour = Imath::V3f(p[0], p[1], p[2]) * matrix;
            std::copy_n(&colour.x, 3, p);
        }
        return true;
    } catch (const std::exception&) {
        return false;
    }
}

} // namespace shoal::media
