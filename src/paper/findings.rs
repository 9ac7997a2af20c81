//! The names of the findings: what the listings do and the text does not say. Their register, with what
//! each is, is `studies::audit::findings`.

use base::choices;

choices! {
    /// The name of a finding. C: of `c_cnt`; K: of `Km` and the iterations.
    #[expect(missing_docs, reason = "the register says what each is")]
    #[derive(PartialOrd, Ord)]
    FindingId {
        C1 = "C1", C2 = "C2", C3 = "C3", C4 = "C4", C5 = "C5", C6 = "C6", C7 = "C7", C8 = "C8",
        C9 = "C9", C10 = "C10", C11 = "C11", C12 = "C12", C13 = "C13", C14 = "C14", C15 = "C15",
        K1 = "K1", K2 = "K2", K3 = "K3", K4 = "K4", K5 = "K5", K6 = "K6", K7 = "K7", K8 = "K8",
        K9 = "K9",
    }
}
