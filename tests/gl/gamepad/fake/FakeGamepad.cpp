#include "tests/gl/gamepad/fake/FakeGamepad.h"

#include <linux/input.h>

#include <algorithm>
#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <dirent.h>
#include <dlfcn.h>
#include <fcntl.h>
#include <string>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

namespace shoal::test {

namespace {

constexpr char kFolder[] = "/dev/input", kNode[] = "/dev/input/event0", kName[] = "Microsoft X-Box 360 pad";
constexpr input_id kId{.bustype = BUS_USB, .vendor = 0x045e, .product = 0x028e, .version = 0x0110};
constexpr int kKeys[] = {BTN_SOUTH,  BTN_EAST,  BTN_NORTH, BTN_WEST,   BTN_TL,    BTN_TR,
                         BTN_SELECT, BTN_START, BTN_MODE,  BTN_THUMBL, BTN_THUMBR};
constexpr int kAxes[] = {ABS_X, ABS_Y, ABS_Z, ABS_RX, ABS_RY, ABS_RZ, ABS_HAT0X, ABS_HAT0Y};

// Returns the system's function that ours replaces.
template <class Function> Function* real(const char* name) {
    return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

// A folder with an entry for the pad, in place of /dev/input.
const char* folder() {
    static const std::string made = [] {
        char name[] = "/tmp/shoal-fake-input-XXXXXX";
        const char* created = mkdtemp(name);
        std::string path = created ? created : "";
        const std::string node = path + "/event0";
        if (FILE* file = std::fopen(node.c_str(), "w")) std::fclose(file);
        return path;
    }();
    static const struct Removal {
        ~Removal() {
            unlink((made + "/event0").c_str());
            rmdir(made.c_str());
        }
    } removal;
    return made.c_str();
}

template <size_t kCount> void setBits(void* to, size_t size, const int (&codes)[kCount]) {
    auto* bytes = static_cast<uint8_t*>(to);
    for (const int code : codes)
        if (static_cast<size_t>(code / 8) < size) bytes[code / 8] |= static_cast<uint8_t>(1 << code % 8);
}

// Answers an ioctl as the driver xpad does.
int answer(FakeGamepad& pad, unsigned long request, void* to) {
    const size_t size = _IOC_SIZE(request);
    const unsigned number = _IOC_NR(request);
    if (_IOC_TYPE(request) != 'E') return errno = ENOTTY, -1;
    if (request == EVIOCGID) return std::memcpy(to, &kId, sizeof kId), 0;
    if (request == EVIOCSFF) {
        auto* effect = static_cast<ff_effect*>(to);
        if (effect->id < 0) effect->id = 0;
        pad.upload({effect->u.rumble.strong_magnitude, effect->u.rumble.weak_magnitude});
        return 0;
    }
    if (number == _IOC_NR(EVIOCGNAME(0))) {
        std::snprintf(static_cast<char*>(to), size, "%s", kName);
        return static_cast<int>(sizeof kName);
    }
    if (number >= _IOC_NR(EVIOCGABS(0)) && number < _IOC_NR(EVIOCGABS(ABS_CNT))) {
        const int axis = static_cast<int>(number - _IOC_NR(EVIOCGABS(0)));
        const bool trigger = axis == ABS_Z || axis == ABS_RZ, hat = axis == ABS_HAT0X || axis == ABS_HAT0Y;
        const auto [low, high] = trigger ? std::pair(0, 255)
                                 : hat   ? std::pair(-1, 1)
                                         : std::pair(-32768, 32767);
        *static_cast<input_absinfo*>(to) = {pad.axis(axis), low, high, 0, 0, 0};
        return 0;
    }
    if (number < _IOC_NR(EVIOCGBIT(0, 0)) || number > _IOC_NR(EVIOCGBIT(EV_MAX, 0)))
        return errno = EINVAL, -1;
    std::memset(to, 0, size);
    switch (number - _IOC_NR(EVIOCGBIT(0, 0))) {
    case 0:
        setBits(to, size, {EV_SYN, EV_KEY, EV_ABS, EV_FF});
        break;
    case EV_KEY:
        setBits(to, size, kKeys);
        break;
    case EV_ABS:
        setBits(to, size, kAxes);
        break;
    case EV_FF:
        setBits(to, size, {FF_RUMBLE});
        break;
    }
    return static_cast<int>(size);
}

} // namespace

FakeGamepad& fakeGamepad() {
    static FakeGamepad& pad = *new FakeGamepad; // files are closed to the very end of the process
    return pad;
}

void FakeGamepad::push(uint16_t type, int code, int value) {
    const std::lock_guard lock(mutex_);
    if (type == EV_ABS) axes_[code] = value;
    events_.push_back({type, static_cast<uint16_t>(code), value});
}

std::vector<Rumble> FakeGamepad::felt() const {
    const std::lock_guard lock(mutex_);
    return felt_;
}

void FakeGamepad::play(bool on) {
    const std::lock_guard lock(mutex_);
    felt_.push_back(on ? uploaded_ : Rumble{});
}

bool FakeGamepad::opened() const {
    const std::lock_guard lock(mutex_);
    return !open_.empty();
}

int FakeGamepad::open() {
    const int fd = real<int(const char*, int, ...)>("open")("/dev/null", O_RDONLY | O_CLOEXEC);
    const std::lock_guard lock(mutex_);
    open_.push_back(fd);
    return fd;
}

void FakeGamepad::close(int fd) {
    const std::lock_guard lock(mutex_);
    std::erase(open_, fd);
}

bool FakeGamepad::isOpen(int fd) const {
    const std::lock_guard lock(mutex_);
    return std::ranges::find(open_, fd) != open_.end();
}

bool FakeGamepad::poll(Event& event) {
    if (!polled_ && onPoll) onPoll();
    polled_ = true;
    const std::lock_guard lock(mutex_);
    if (events_.empty()) return polled_ = false;
    event = events_.front();
    events_.erase(events_.begin());
    return true;
}

} // namespace shoal::test

// -- In the system's place ---------------------------------------------------------------------------------

using shoal::test::fakeGamepad;
using shoal::test::real;

extern "C" {

int open(const char* path, int flags, ...) {
    std::va_list more;
    va_start(more, flags);
    const mode_t mode = flags & (O_CREAT | __O_TMPFILE) ? va_arg(more, mode_t) : 0;
    va_end(more);
    if (std::strcmp(path, shoal::test::kNode) == 0) return fakeGamepad().open();
    return real<int(const char*, int, ...)>("open")(path, flags, mode);
}

int openat(int folder, const char* path, int flags, ...) {
    std::va_list more;
    va_start(more, flags);
    const mode_t mode = flags & (O_CREAT | __O_TMPFILE) ? va_arg(more, mode_t) : 0;
    va_end(more);
    if (std::strcmp(path, shoal::test::kFolder) == 0) path = shoal::test::folder();
    return real<int(int, const char*, int, ...)>("openat")(folder, path, flags, mode);
}

DIR* opendir(const char* path) {
    return real<DIR*(const char*)>("opendir")(
        std::strcmp(path, shoal::test::kFolder) == 0 ? shoal::test::folder() : path);
}

int ioctl(int fd, unsigned long request, ...) {
    std::va_list more;
    va_start(more, request);
    void* to = va_arg(more, void*);
    va_end(more);
    if (fakeGamepad().isOpen(fd)) return shoal::test::answer(fakeGamepad(), request, to);
    return real<int(int, unsigned long, ...)>("ioctl")(fd, request, to);
}

ssize_t read(int fd, void* to, size_t size) {
    if (!fakeGamepad().isOpen(fd)) return real<ssize_t(int, void*, size_t)>("read")(fd, to, size);
    shoal::test::FakeGamepad::Event event{};
    if (size < sizeof(input_event) || !fakeGamepad().poll(event)) return errno = EAGAIN, -1;
    *static_cast<input_event*>(to) = {
        .time = {}, .type = event.type, .code = event.code, .value = event.value};
    return sizeof(input_event);
}

ssize_t write(int fd, const void* from, size_t size) {
    if (!fakeGamepad().isOpen(fd)) return real<ssize_t(int, const void*, size_t)>("write")(fd, from, size);
    const auto* event = static_cast<const input_event*>(from);
    if (size != sizeof *event || event->type != EV_FF) return errno = EINVAL, -1;
    fakeGamepad().play(event->value > 0);
    return static_cast<ssize_t>(size);
}

int close(int fd) {
    fakeGamepad().close(fd);
    return real<int(int)>("close")(fd);
}

} // extern "C"
