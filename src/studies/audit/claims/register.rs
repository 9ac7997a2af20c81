//! What the paper says, in the order of its text.

use super::{Basis, Claim, Measure, Verdict, measures};
use base::choices;
use paper::findings::FindingId;

choices! {
    /// The name of a claim.
    #[expect(missing_docs, reason = "the table says what each is")]
    ClaimId {
        P1 = "P1",
        P2 = "P2",
        P3 = "P3",
        P4 = "P4",
        P5 = "P5",
        P6 = "P6",
        P7 = "P7",
        P8 = "P8",
        P9 = "P9",
        P10 = "P10",
        P11 = "P11",
        P12 = "P12",
        P13 = "P13",
    }
}

/// Where the thresholds of this audit come from.
const HUNDREDTH: &str = "1 %, a change that shows in a picture: this audit's; the paper gives none";
const COUNT: &str = "none: a single one decides";

/// All claims, in the order of their ids, which is that of the text.
pub const CLAIMS: &[Claim] = &[
    Claim {
        id: ClaimId::P1,
        place: "statement of the problem, the sentence of eq. (1)",
        quote: "Перемещения по нормали к поверхности контакта совпадают из условия непроникновения одного \
                из контактирующих тел (далее домена) в другое [5,9]",
        translation: "Displacements along the normal to the contact surface coincide, by the condition that \
                      neither of the bodies in contact (below: domains) penetrates the other [5,9]",
        judged: "nothing penetrates at the end, and no node in contact pulls",
        condition: "at the end of the scene's variant of the paper no contact node is inside the target, in \
                    contact or not, and no node in contact pulls",
        threshold: "of penetration 1 % of the target's largest displacement: this audit's; the paper gives \
                    none; of a pull, more than rounding",
        is_ours: true,
        basis: Basis::Runs,
        number: "largest penetration of a contact node at the end of the scene's variant of the paper, over \
                 the largest displacement of the target",
        command: &["audit", "SCENE", "--json"],
        at: &["/variants/VARIANT/penetration/relative"],
        measure: Measure::Scene(measures::penetrates),
    },
    Claim {
        id: ClaimId::P2,
        place: "statement of the problem, the sentence of eq. (1)",
        quote: "по касательной к поверхности зоны контакта – из условия равновесия действия сил трения между \
                контактирующими поверхностями",
        translation: "along the tangent to the surface of the contact zone – by the condition of equilibrium \
                      of the friction forces between the surfaces in contact",
        judged: "equal displacements along the tangent are the equilibrium of friction",
        condition: "under unilateral no node in contact needs more friction than there is, on the whole path of the load",
        threshold: "none: the value is the least coefficient of friction, which runs 0.1 % above and below confirm; \
                    the paper gives none",
        is_ours: false,
        basis: Basis::Runs,
        number: "largest shear over pressure of a node in contact on the path of unilateral, sticking",
        command: &["audit", "SCENE", "--claim", "P2", "--json"],
        at: &["/number"],
        measure: Measure::Confirmed(measures::friction_needed, measures::confirmed),
    },
    Claim {
        id: ClaimId::P3,
        place: "statement of the problem, the sentence of eq. (1)",
        quote: "тогда для контактирующих поверхностей: u_cont = u_targ; v_cont = v_targ, (1)",
        translation: "then, for the surfaces in contact: u_cont = u_targ; v_cont = v_targ, (1)",
        judged: "displacements of linked nodes are equal in the system that is solved",
        condition: "the matrix MJS of Km has entries that join the two bodies",
        threshold: "none: without any the bodies are not coupled",
        is_ours: false,
        basis: Basis::Listing,
        number: "entries of MJS that join the two bodies, on the finding's scene",
        command: &["audit", "--finding", "K1", "--json"],
        at: &["/number"],
        measure: Measure::Refuted(FindingId::K1),
    },
    Claim {
        id: ClaimId::P4,
        place: "paragraph on fig. 1",
        quote: "Первоначально, для каждого узла штампа на основе текущих координат узлов обоих доменов \
                производится поиск элемента, с которым он, предположительно, может взаимодействовать.",
        translation: "First, for each node of the stamp, an element with which it presumably can interact is \
                      searched for, on the basis of the current coordinates of the nodes of both domains.",
        judged: "the search for a target edge takes current coordinates",
        condition: "a node finds the same edge where the current coordinates of both bodies are moved far away \
                    together; that the weights take initial ones is finding C6",
        threshold: COUNT,
        is_ours: false,
        basis: Basis::Listing,
        number: "contact nodes that find another edge then, on the scene of finding C7",
        command: &["audit", "--claim", "P4", "--json"],
        at: &["/number"],
        measure: Measure::Scene(measures::searches_current),
    },
    Claim {
        id: ClaimId::P5,
        place: "paragraph on fig. 1, of its node 2.4",
        quote: "Одним из вариантов взаимного расположения узлов может быть ситуация, когда переместившись, \
                узел контактной поверхности штампа попадает в пространство во внутреннее пространство \
                основной конструкции на расстояние, превышающее c_tol, т.е. описанный выше алгоритм покажет \
                в качестве результата отсутствие контактного взаимодействия (см. рис.1 узел 2.4).",
        translation: "One of the possible mutual positions of nodes is that a node of the contact surface of \
                      the stamp, having moved, is inside the main structure by a distance above c_tol, i.e. \
                      the algorithm described above will show as its result that there is no contact (see \
                      fig. 1, node 2.4).",
        judged: "a node deeper inside than c_tol is treated as separated",
        condition: "c_cnt finds such a node no target edge",
        threshold: COUNT,
        is_ours: false,
        basis: Basis::Listing,
        number: "nodes inside the target, deeper than c_tll, without a target edge, on the finding's scene",
        command: &["audit", "--finding", "C9", "--json"],
        at: &["/number"],
        measure: Measure::Finding(
            FindingId::C9,
            Verdict::True,
            "lines 5 to 7 find it no target edge",
        ),
    },
    Claim {
        id: ClaimId::P6,
        place: "the second of the two solutions, before fig. 2",
        quote: "В этом случае существует два решения: … сравнение знаков Yi соседних узлов",
        translation: "In this case there are two solutions: … comparing the signs of Yi of neighbouring nodes",
        judged: "comparing signs of neighbours finds the nodes that jumped deeper than c_tol",
        condition: "in random scenes, after a jump to twice c_tll, the rule misses no node in contact, the \
                    target below the stamp or above",
        threshold: HUNDREDTH,
        is_ours: true,
        basis: Basis::Random,
        number: "share of the nodes in contact that the rule misses, the target below, after a jump to \
                 twice c_tll",
        command: &[],
        at: &[],
        measure: Measure::Scene(measures::signs_go_wrong),
    },
    Claim {
        id: ClaimId::P7,
        place: "the second of the two solutions, before fig. 2",
        quote: "в этом случае всем узлам контактирующей поверхности штампа, находящимся на расстоянии от \
                ответной поверхности не превышающим c_tol, назначается фиксированное значение Yi.",
        translation: "in this case all nodes of the contact surface of the stamp whose distance from the \
                      opposite surface is not above c_tol are given a fixed value of Yi.",
        judged: "nodes within c_tol are given a fixed Y before signs are compared",
        condition: "no node apart is in contact because of a neighbour that is itself within c_tll",
        threshold: COUNT,
        is_ours: false,
        basis: Basis::Listing,
        number: "nodes apart by c_tll or more, flagged beside nodes that only touch, on the \
                 finding's scene",
        command: &["audit", "--finding", "C15", "--json"],
        at: &["/number"],
        measure: Measure::Refuted(FindingId::C15),
    },
    Claim {
        id: ClaimId::P8,
        place: "after the two solutions, before fig. 2",
        quote: "Второй вариант представляется более предпочтительным с точки зрения объемов вычислений.",
        translation: "The second option appears preferable from the point of view of the volume of \
                      computation.",
        judged: "comparing signs takes fewer operations than intersecting elements",
        condition: "in random scenes the sign rule takes fewer operations on lengths than the intersection",
        threshold: "none: the quotient is above 1",
        is_ours: false,
        basis: Basis::Random,
        number: "operations of the intersection over those of the sign rule, on the largest surfaces tried",
        command: &[],
        at: &[],
        measure: Measure::Scene(measures::fewer_operations),
    },
    Claim {
        id: ClaimId::P9,
        place: "paragraph before fig. 2",
        quote: "Было принято, что исходя из соразмерности размеров КЭ контактирующих поверхностей обоих \
                доменов, каждый узел любой из рассматриваемых поверхностей связан с двумя узлами ответной",
        translation: "It was assumed that, as the elements of the contact surfaces of both domains are of \
                      comparable size, every node of either surface is linked with two nodes of the opposite \
                      one",
        judged: "every node of either surface is linked with two nodes of the other",
        condition: "no target node has two or more contact nodes tied to it: its row of k_cnt has room for \
                    one",
        threshold: COUNT,
        is_ours: false,
        basis: Basis::Listing,
        number: "target nodes to which two or more contact nodes are tied, on the finding's scene",
        command: &["audit", "--finding", "C7", "--json"],
        at: &["/number"],
        measure: Measure::Refuted(FindingId::C7),
    },
    Claim {
        id: ClaimId::P10,
        place: "paragraph before fig. 2",
        quote: "Было принято, что … а так же, что величина значения c_tol = 0,001 мала для внесения в результат расчета ощутимой \
                погрешности.",
        translation: "It was assumed that … and also that the value c_tol = 0.001 is too small to bring a noticeable error into the \
                      result of the analysis.",
        judged: "c_tol = 0.001 brings no noticeable error",
        condition: "no node's displacement changes noticeably when c_tol is divided by 1,000",
        threshold: HUNDREDTH,
        is_ours: true,
        basis: Basis::Runs,
        number: "largest difference of a node's displacement between c_tol and a thousandth of it, over \
                 the largest displacement at c_tol",
        command: &["audit", "SCENE", "--claim", "P10", "--json"],
        at: &["/number"],
        measure: Measure::Scene(measures::tolerance),
    },
    Claim {
        id: ClaimId::P11,
        place: "data of the example, between fig. 4 and fig. 5",
        quote: "Расчет выполняется итерационно, состоит из 20 итераций.",
        translation: "The analysis is iterative and consists of 20 iterations.",
        judged: "under the whole load (tied) the contact state settles in 20 iterations",
        condition: "under tied the contact state has settled in the last iteration; that 20 are enough, and \
                    the whole load in each, are this audit's reading: the paper says neither",
        threshold: "none: the period is 1",
        is_ours: true,
        basis: Basis::Runs,
        number: "final period of the contact state under tied, iterations; 1 = settled, 0 = none yet",
        command: &["audit", "SCENE", "--json"],
        at: &["/variants/1/cycle/length"],
        measure: Measure::Scene(measures::settles),
    },
    Claim {
        id: ClaimId::P12,
        place: "the sentence before fig. 5",
        quote: "Данные результаты совпадают с аналогичным численным экспериментом, проведенном в программном \
                комплексе Autodesk Simulation Mechanical 2013.",
        translation: "These results coincide with those of a similar numerical experiment, carried out in \
                      the software Autodesk Simulation Mechanical 2013.",
        judged: "a variant of the paper reaches the equilibrium within a hundredth",
        condition: "a variant of the paper reaches the equilibrium under the scene's own friction on the \
                    same mesh: what another code solves correctly, for that code itself is P13",
        threshold: HUNDREDTH,
        is_ours: true,
        basis: Basis::Runs,
        number: "distance of the nearest variant of the paper from the equilibrium under the scene's own \
                 friction, in the energy norm, over that of the equilibrium",
        command: &["audit", "SCENE", "--json"],
        at: &["/variants/VARIANT/distance/energy_relative"],
        measure: Measure::Scene(measures::error_of_the_reading),
    },
    Claim {
        id: ClaimId::P13,
        place: "the sentence before fig. 5",
        quote: "Данные результаты совпадают с аналогичным численным экспериментом, проведенном в программном \
                комплексе Autodesk Simulation Mechanical 2013.",
        translation: "These results coincide with those of a similar numerical experiment, carried out in \
                      the software Autodesk Simulation Mechanical 2013.",
        judged: "that program gives the same results",
        condition: "that program, with its contact settings, gives the same results",
        threshold: "none: nothing to compare with",
        is_ours: false,
        basis: Basis::Nothing,
        number: "none",
        command: &["audit", "SCENE", "--json"],
        at: &[],
        measure: Measure::Nothing(
            "neither the code, its version's contact settings, the mesh nor the radii are given",
        ),
    },
];

one_row_for_each!(ClaimId, CLAIMS);
