//! Mathcad's own names that the interpreter does not have, so that they are called its lack and not
//! a fault of the worksheet.

/// Functions of Mathcad 13 to 15, with white space between them.
pub const FUNCTIONS: &str = "
    acot acoth acsc acsch Adams AdamsBDF Ai angle APPENDPRN arg asec asech atan2 BDF Bi bspline
    bulstoer Bvalfit bvalfit Ceil ceiling CFFT cfft cholesky combin concat cond1 cond2 conde condi
    corr correl correlogram coth CreateMesh CreateSpace csch csgn csort cspline cvar cwt cyl2xyz
    dbeta dbinom dcauchy dchisq depc dexp dF dgamma dgeom dhypergeom diag dlnorm dlogis dnbinom
    dnorm dpois dt dunif dweibull eff eigenvec erf erfc error expfit expm1 FFT
    fft fhyper Find Floor fv fvadj fvc Gamma gcd genfit geninv genvals genvecs GETWAVINFO gmean
    GREEN Her hist histogram hlookup hmean I0 I1 ibeta ICFFT icfft icwt IFFT ifft Im In intercept
    interp invsum ipmt irr IsArray IsFunction IsNaN IsPrime IsScalar IsString iwave J0 J1 Jac Jn js
    K0 K1 kmeans Kn Kronecker ksmooth kurt Lag lcm Leg lgsfit line linfit linterp lnfit lnGamma
    lnorm LoadColormap localmax localmin loess log1p logfit logpts logspace lookup lowpass lspline
    lu markovint match matrix Maximize median medsmooth mhyper Minerr Minimize mode movavg multigrid
    nom norm1 norm2 norme normi nper npv num2str Odesolve pbeta pbinom pcauchy pchisq Pdesolve
    permut pexp pF pgamma pgeom phypergeom plnorm plogis pmt pnbinom pnorm pol2xy polycoeff
    Polyhedron polyiter polyroots ppmt ppois predict pspline pt punif pv pweibull pwrfit qbeta
    qbinom qcauchy qchisq qexp qF qgamma qgeom qhypergeom qlnorm qlogis qnbinom qnorm qpois qr qrank
    qt qunif qweibull Radau rank rate rbeta rbinom rcauchy rchisq Re READ READBIN READBMP READCSV
    READEXCEL READFILE READPRN READRGB READWAV regress relax reverse rexp rF rgamma rgeom rhypergeom
    Rkadapt rkadapt rkfixed rlnorm rlogis rnbinom rnd rnorm root Round rpois rref rsort rt runif
    rweibull SaveColormap sbval search sec2xyz sech Seed sign signum sinc sinfit skew slope sph2xyz
    stderr Stdev stdev Stiffb stiffb Stiffr stiffr str2num str2vec strlen substr supsmooth svd svd2
    svds Tcheb thiele thielecoeff time tr Trunc Ucheb until UnwrapPhase Var var vec2str VHmax
    vlookup vmatch WRITEBIN WRITEBMP WRITECSV WRITEEXCEL WRITEPRN WRITERGB WRITEWAV xy2pol xyz2cyl
    xyz2sph Y0 Y1 Yn Ys ys Γ δ ε σ Φ";

/// Units of Mathcad 13 to 15, as the worksheet names them: `m`, `kN`. Those of the angles are
/// numbers here.
pub const UNITS: &str = "
    m meter dm cm mm km μm µm nm pm in ft yd mi mil inch foot yard mile nmi angstrom Å furlong rod fathom ly au
    kg gm mg μg µg tonne lb lbm oz slug ton longton shortton quintal stone carat grain amu
    s sec ms μs µs ns ps min hr day yr year
    A amp mA μA µA nA kA V volt mV μV µV kV MV Ω ohm mΩ kΩ MΩ S siemens mho mS F farad mF μF µF nF pF
    H henry mH μH µH nH C coul coulomb Wb weber T tesla mT gauss oersted statvolt statcoul statfarad abvolt faraday
    K °C °F °R Δ°C Δ°F R ΔC ΔF kelvin mK
    N newton mN kN MN GN daN dyne dyn lbf kgf gf tonf tonnef kip ozf poundal pdl
    Pa kPa MPa GPa hPa psi ksi Msi psf atm bar mbar torr mmHg in_Hg inHg
    J joule mJ kJ MJ GJ cal kcal BTU erg eV keV MeV Wh kWh therm ft_lb
    W watt mW kW MW GW hp hhp mhp kVA VA
    Hz kHz MHz GHz THz rpm rps Bq kBq curie Ci becquerel Gy Sv rem
    L l liter litre mL ml dL cL gal qt pt fl_oz barrel bbl acre hectare
    mph kph kmh knot kt fps g0
    mol mole kmol mmol cd candela lm lumen lx lux
    poise stokes cP cSt kat sr steradian % percent ppm dB
    ° grad gon rev turn arcmin arcsec";

/// Returns whether a name is that of a function of Mathcad's.
pub fn is_function(name: &str) -> bool {
    contains(FUNCTIONS, name)
}

/// Returns what a name that nothing defines is of Mathcad's, in the words of an unsupported construct.
pub fn construct(name: &str) -> Option<String> {
    if is_function(name) {
        Some(format!("the function {name}"))
    } else if is_unit(name) {
        Some(format!("units: {name}"))
    } else {
        None
    }
}

/// Returns whether a name is one of Mathcad's units, or made of them, as `kN.m` is.
pub fn is_unit(name: &str) -> bool {
    let parts = || name.split(['.', '·', '⋅', '*', '/', '^']);
    let known = |part: &str| contains(UNITS, part.trim_end_matches(|c: char| c.is_ascii_digit()));
    parts().next().is_some_and(known) && parts().all(|part| known(part) || is_exponent(part))
}

fn is_exponent(part: &str) -> bool {
    !part.is_empty() && part.bytes().all(|byte| byte.is_ascii_digit() || byte == b'-')
}

fn contains(list: &str, name: &str) -> bool {
    list.split_whitespace().any(|known| known == name)
}
