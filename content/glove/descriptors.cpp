// What the glove tells the host about itself, as TinyUSB asks for it.
#include "GloveCore.h"

#include "pico/unique_id.h"
#include "tusb.h"

#include <cstring>

namespace {

constexpr uint8_t kIn = 0x81, kOut = 0x01, kAsked_ms = 1, kPacketBytes = 32;

const tusb_desc_device_t device = {.bLength = sizeof(tusb_desc_device_t),
                                   .bDescriptorType = TUSB_DESC_DEVICE,
                                   .bcdUSB = 0x0200,
                                   .bDeviceClass = 0,
                                   .bDeviceSubClass = 0,
                                   .bDeviceProtocol = 0,
                                   .bMaxPacketSize0 = CFG_TUD_ENDPOINT0_SIZE,
                                   .idVendor = glove::kVendor,
                                   .idProduct = glove::kProduct,
                                   .bcdDevice = 0x0100,
                                   .iManufacturer = 1,
                                   .iProduct = 2,
                                   .iSerialNumber = 3,
                                   .bNumConfigurations = 1};

const uint8_t configuration[] = {
    TUD_CONFIG_DESCRIPTOR(1, 1, 0, TUD_CONFIG_DESC_LEN + TUD_HID_INOUT_DESC_LEN, 0, 500),
    TUD_HID_INOUT_DESCRIPTOR(0, 0, HID_ITF_PROTOCOL_NONE, sizeof(glove::kReportDescriptor), kOut, kIn,
                             kPacketBytes, kAsked_ms)};

} // namespace

extern "C" {

const uint8_t* tud_descriptor_device_cb() { return reinterpret_cast<const uint8_t*>(&device); }
const uint8_t* tud_descriptor_configuration_cb(uint8_t) { return configuration; }
const uint8_t* tud_hid_descriptor_report_cb(uint8_t) { return glove::kReportDescriptor; }

// UTF-16, behind a head of length and kind.
const uint16_t* tud_descriptor_string_cb(uint8_t index, uint16_t) {
    static uint16_t text[33];
    char serial[2 * PICO_UNIQUE_BOARD_ID_SIZE_BYTES + 1];
    pico_get_unique_board_id_string(serial, sizeof serial);
    const char* const texts[] = {"", "Shoal", "Fingertip glove", serial};
    size_t length = 0;
    if (index == 0) {
        text[1] = 0x0409; // English
        length = 1;
    } else if (index < 4) {
        length = std::strlen(texts[index]);
        for (size_t i = 0; i < length && i < 32; ++i) text[1 + i] = static_cast<uint8_t>(texts[index][i]);
    } else {
        return nullptr;
    }
    text[0] = static_cast<uint16_t>(TUSB_DESC_STRING << 8 | (2 * length + 2));
    return text;
}
}
