#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| plane_contact_fuzz::solve::hold(data));
