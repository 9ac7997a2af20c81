#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| plane_contact_fuzz::options::hold(data));
