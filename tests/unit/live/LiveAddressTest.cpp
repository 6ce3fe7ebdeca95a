#include "engine/media/live/LivePlayer.h"

#include "tests/unit/media/TestFiles.h"

#include <sys/stat.h>

namespace shoal::media {
namespace {

template <class Kind> const Kind* as(const Result<std::optional<LiveAddress>>& address) {
    return address && *address ? std::get_if<Kind>(&**address) : nullptr;
}

TEST(LiveAddress, Cameras) {
    const auto first = liveAddress("camera:0"), last = liveAddress("camera:42");
    ASSERT_TRUE(as<CameraAddress>(first));
    EXPECT_EQ(as<CameraAddress>(first)->index, 0);
    EXPECT_EQ(as<CameraAddress>(last)->index, 42);
    for (const char* none :
         {"camera:", "camera:x", "camera:-1", "camera:100", "camera:1 ", "camera:/dev/video0"})
        EXPECT_FALSE(liveAddress(none)) << none;
}

TEST(LiveAddress, StreamsByTheirSchemesAlone) {
    for (const char* url :
         {"rtsp://host/a", "http://host:1/a?b=c", "https://host/", "tcp://127.0.0.1:9", "udp://@:1"}) {
        const auto address = liveAddress(url);
        ASSERT_TRUE(as<StreamAddress>(address)) << url;
        EXPECT_EQ(std::string(as<StreamAddress>(address)->protocols).find("file"), std::string::npos);
    }
    for (const char* url : {"file:///etc/passwd", "concat://a|b", "ftp://host/a", "HTTP://host/", "data://x",
                            "rtmp://a/b", "subfile,,start,0,end,9,,://x"}) {
        const auto address = liveAddress(url);
        EXPECT_FALSE(as<StreamAddress>(address)) << url;
    }
    const auto refused = liveAddress("rtmp://user:secret@host/a");
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().reason.find("rtsp, http, https, tcp, udp"), std::string::npos);
    EXPECT_EQ(refused.error().message().find("secret"), std::string::npos);
    EXPECT_FALSE(liveAddress("http://" + std::string(5000, 'a')));
}

TEST(LiveAddress, FilesAreFilesAndPipesArePipes) {
    const TempFolder folder;
    ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
    writeBytes(folder / "file", "x");
    const auto pipe = liveAddress((folder / "pipe").string());
    EXPECT_TRUE(as<StreamAddress>(pipe) && as<StreamAddress>(pipe)->isPipe);
    for (const Path& file :
         {folder / "file", folder / "missing", Path("a.mp4"), Path("camera.mp4"), Path("")}) {
        const auto address = liveAddress(file.string());
        ASSERT_TRUE(address);
        EXPECT_FALSE(*address) << file;
    }
}

TEST(LiveAddress, PasswordsAreNotShown) {
    EXPECT_EQ(withoutPassword("rtsp://me:secret@host:554/a"), "rtsp://host:554/a");
    EXPECT_EQ(withoutPassword("rtsp://me:sec@ret@host/a@b"), "rtsp://host/a@b");
    EXPECT_EQ(withoutPassword("http://host/a@b"), "http://host/a@b");
    EXPECT_EQ(withoutPassword("camera:0"), "camera:0");
}

TEST(Camera, OneThatIsNotThereSaysSo) {
    if (std::filesystem::exists("/dev/video98")) GTEST_SKIP() << "a machine with 99 cameras";
    const auto player = LivePlayer::open(feedFrom(CameraAddress{98}));
    ASSERT_FALSE(player);
    EXPECT_EQ(player.error().message(),
              "camera:98: is not there; `shoal devices` lists the cameras that are");
    for (const CameraListed& camera : listCameras()) EXPECT_NE(camera.index, 98);
}

} // namespace
} // namespace shoal::media
