// The glove's firmware for a Raspberry Pi Pico: reports come in over USB, twelve pins follow their waves.
// What can be reasoned about without the hardware is in GloveCore.h.
#include "GloveCore.h"

#include "hardware/pwm.h"
#include "pico/stdlib.h"
#include "tusb.h"

namespace {

constexpr uint kFirstPin = 2;
constexpr uint8_t kFull = 255;

glove::State
    state; // of the main loop alone: TinyUSB calls back from tud_task(), the samples are made there too

uint32_t now_ms() { return to_ms_since_boot(get_absolute_time()); }

void startPins() {
    for (uint pin = kFirstPin; pin < kFirstPin + glove::kActuators; ++pin) {
        gpio_set_function(pin, GPIO_FUNC_PWM);
        pwm_config config = pwm_get_default_config();
        pwm_config_set_wrap(&config, kFull); // 125 MHz / 256: far above what an actuator or an ear follows
        pwm_init(pwm_gpio_to_slice_num(pin), &config, true);
        pwm_set_gpio_level(pin, 0);
    }
}

} // namespace

extern "C" {

// On the interrupt endpoint or by a control request; without report ids the bytes are the same.
void tud_hid_set_report_cb(uint8_t, uint8_t, hid_report_type_t, const uint8_t* bytes, uint16_t size) {
    glove::receive(state, bytes, size, now_ms());
}

uint16_t tud_hid_get_report_cb(uint8_t, uint8_t, hid_report_type_t, uint8_t*, uint16_t) { return 0; }

void tud_umount_cb() { glove::stop(state); }
void tud_suspend_cb(bool) { glove::stop(state); }
}

int main() {
    startPins();
    tusb_init();
    constexpr uint32_t kSample_us = 1000000 / glove::kSampleRate_Hz;
    uint32_t next_us = time_us_32();
    while (true) {
        tud_task();
        glove::watch(state, now_ms());
        if (static_cast<int32_t>(time_us_32() - next_us) < 0) continue;
        next_us += kSample_us;
        for (int i = 0; i < glove::kActuators; ++i)
            pwm_set_gpio_level(kFirstPin + static_cast<uint>(i), glove::nextSample(state, i));
    }
}
