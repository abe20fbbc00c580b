/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "impact/oscillator.h"

#include <math.h>
#include <string.h>

#include "base/vector_clones.h"

/* Four nodes, or four other places of a step, together; and complex numbers at them. */
typedef double quad __attribute__((vector_size(NODES * sizeof(double))));
struct waves {
    quad re, im;
};

/* ---- Maps over a step ---- */

double complex oscillator_lambda(double omega, double damping)
{
    return omega * CMPLX(-damping, sqrt((1.0 - damping) * (1.0 + damping)));
}

/* Largest exponent of growth when damping runs backward: squares stay finite. */
static const double LARGEST_EXPONENT = 300.0;

/* From this |z c| on the moments are found by upward recurrence, see oscillator_moments. */
static const double LARGE = 3.0;

/* Terms of the series of small_moments to the last bit, by |z c|^2: |z c|^k 4!/(4 + k)! < 1e-17. */
static const struct {
    double below;
    int terms;
} SERIES[] = {{2.5e-5, 6}, {2.5e-3, 8}, {6.25e-2, 11}, {0.5625, 15}, {2.25, 19}, {INFINITY, 25}};

/* Products without the standard's profile for infinite factors, of which there are none here. */
static inline double complex times(double complex a, double complex b)
{
    return CMPLX(creal(a) * creal(b) - cimag(a) * cimag(b),
                 creal(a) * cimag(b) + cimag(a) * creal(b));
}

static inline double square(double complex x)
{
    return creal(x) * creal(x) + cimag(x) * cimag(x);
}

/* Free motion: q(t) = Re(A e^(lambda t)) with A from q(0), v(0); in real numbers, with
 * lambda = -r + i w (r, w: `-decay`, `frequency`),
 *
 *   q(t) = e^(-r t) ((cos wt + (r/w) sin wt) q(0) + (1/w) sin wt v(0))
 *   v(t) = e^(-r t) (-((r^2 + w^2)/w) sin wt q(0) + (cos wt - (r/w) sin wt) v(0)) */
static void free_map(double complex lambda, double time, double to_q[2], double to_v[2])
{
    double decay = creal(lambda);
    double frequency = cimag(lambda);
    double scale = exp(fmin(decay * time, LARGEST_EXPONENT));
    double sine = scale * sin(frequency * time) / frequency;
    double cosine = scale * cos(frequency * time);
    to_q[0] = cosine - decay * sine;
    to_q[1] = sine;
    to_v[0] = -(decay * decay + frequency * frequency) * sine;
    to_v[1] = cosine + decay * sine;
}

void oscillator_advance(double omega, double damping, double time, double *q, double *v)
{
    double to_q[2];
    double to_v[2];
    free_map(oscillator_lambda(omega, damping), time, to_q, to_v);
    double moved = to_q[0] * *q + to_q[1] * *v;
    *v = to_v[0] * *q + to_v[1] * *v;
    *q = moved;
}

/* The damper takes 2 zeta omega int v^2 dt; with v = Re(V e^(lambda t)),
 * 2 v^2 = |V|^2 e^(2 Re(lambda) t) + Re(V^2 e^(2 lambda t)). */
double oscillator_free_loss(double omega, double damping, double time, double q, double v)
{
    if (damping == 0.0 || time == 0.0)
        return 0.0;
    /* V from v(0) and v'(0) = -2 zeta omega v - omega^2 q */
    double complex lambda = oscillator_lambda(omega, damping);
    double rate = -2.0 * damping * omega * v - omega * omega * q;
    double complex amplitude = CMPLX(v, (creal(lambda) * v - rate) / cimag(lambda));
    double twice = 2.0 * creal(lambda);
    double steady = expm1(twice * time) / twice;
    double complex swinging = (cexp(2.0 * lambda * time) - 1.0) / (2.0 * lambda);
    double square =
        creal(amplitude * conj(amplitude)) * steady + creal(amplitude * amplitude * swinging);
    return damping * omega * square;
}

/* Of four places c with |z c| < LARGE. int exp(z(c-s)) s^m ds = c^(m+1) m! sum_k x^k / (m+1+k)!,
 * without cancellation for small x = z c, gives the highest moment; by parts, downward, the others,
 * each with an error of at most about |x|/m that of the one before. */
static inline void small_moments(double complex z, const double c[NODES],
                                 struct waves moments[NODES])
{
    quad place;
    memcpy(&place, c, sizeof place);
    struct waves x = {creal(z) * place, cimag(z) * place};
    double largest = fmax(fmax(c[0], c[1]), fmax(c[2], c[3]));
    int row = 0;
    while (!(square(z * largest) < SERIES[row].below))
        row++;
    /* the series by Horner's rule */
    const quad one = {1.0, 1.0, 1.0, 1.0};
    struct waves sum = {one, 0.0 * one};
    for (int k = SERIES[row].terms; k > 0; k--) {
        double share = 1.0 / (NODES + k);
        quad re = x.re * share;
        quad im = x.im * share;
        sum = (struct waves){1.0 + (re * sum.re - im * sum.im), re * sum.im + im * sum.re};
    }
    /* powers of c, and downward */
    quad power[NODES + 1] = {one};
    for (int m = 1; m <= NODES; m++)
        power[m] = power[m - 1] * place;
    quad highest = power[NODES] / NODES;
    moments[NODES - 1] = (struct waves){highest * sum.re, highest * sum.im};
    for (int m = NODES - 1; m > 0; m--) {
        const struct waves *above = &moments[m];
        double share = 1.0 / m;
        moments[m - 1] = (struct waves){
            (creal(z) * above->re - cimag(z) * above->im + power[m]) * share,
            (creal(z) * above->im + cimag(z) * above->re) * share,
        };
    }
}

/* Response to the forces at the nodes: kick[j] = sum_m monomial[j][m] moments[m]. */
static inline void small_kicks(const struct waves moments[NODES], struct waves kick[NODES])
{
    for (int j = 0; j < NODES; j++) {
        const double *monomial = collocation.monomial[j];
        kick[j] = (struct waves){monomial[0] * moments[0].re, monomial[0] * moments[0].im};
        for (int m = 1; m < NODES; m++) {
            kick[j].re += monomial[m] * moments[m].re;
            kick[j].im += monomial[m] * moments[m].im;
        }
    }
}

/* The kicks [j][place] of four places. */
VECTOR_CLONES static void find_small_kicks(double complex z, const double c[NODES],
                                           double re[NODES][NODES], double im[NODES][NODES])
{
    struct waves moments[NODES];
    struct waves kick[NODES];
    small_moments(z, c, moments);
    small_kicks(moments, kick);
    for (int j = 0; j < NODES; j++) {
        memcpy(re[j], &kick[j].re, sizeof re[j]);
        memcpy(im[j], &kick[j].im, sizeof im[j]);
    }
}

/* For |z c| >= LARGE, with wave = exp(z c): by parts, upward, each step divides by |z c|. */
static void large_moments(double complex z, double c, double complex wave,
                          double complex moments[NODES])
{
    double part = 1.0 / square(z);
    double complex inverse = CMPLX(creal(z) * part, -cimag(z) * part);
    double power = 1.0;
    moments[0] = times(wave - 1.0, inverse);
    for (int m = 1; m < NODES; m++) {
        power *= c;
        moments[m] = times(m * moments[m - 1] - power, inverse);
    }
}

/* Kick [j] of one place, with wave = exp(z c). */
static void large_kicks(double complex z, double c, double complex wave, double complex kick[NODES])
{
    double complex moments[NODES];
    large_moments(z, c, wave, moments);
    for (int j = 0; j < NODES; j++) {
        double re = 0.0;
        double im = 0.0;
        for (int m = 0; m < NODES; m++) {
            re += collocation.monomial[j][m] * creal(moments[m]);
            im += collocation.monomial[j][m] * cimag(moments[m]);
        }
        kick[j] = CMPLX(re, im);
    }
}

void oscillator_moments(double complex z, double c, double complex moments[NODES])
{
    if (square(z * c) >= LARGE * LARGE) {
        large_moments(z, c, cexp(z * c), moments);
        return;
    }
    struct waves at[NODES];
    small_moments(z, (double[NODES]){c, c, c, c}, at);
    for (int m = 0; m < NODES; m++)
        moments[m] = CMPLX(at[m].re[0], at[m].im[0]);
}

/* Duhamel: q(T) = free + Im int_0^T e^(lambda (T - t)) f(t) dt / Im(lambda), v with lambda times
 * the kernel; f = sum_j f_j sum_m monomial[j][m] (t/h)^m, T = c h, so that the integrals are h
 * kick[j] with z = lambda h. */
void oscillator_maps(double omega, double damping, double h, size_t count, const double *c,
                     double (*to_q)[NODES + 2], double (*to_v)[NODES + 2])
{
    double complex lambda = oscillator_lambda(omega, damping);
    double complex z = lambda * h;
    double share = h / cimag(lambda);
    double place[NODES];
    double re[NODES][NODES];
    double im[NODES][NODES];
    double largest = 0.0;
    for (size_t i = 0; i < NODES; i++) {
        place[i] = c[i < count ? i : 0];
        largest = fmax(largest, place[i]);
    }
    bool small = square(z * largest) < LARGE * LARGE;
    if (small)
        find_small_kicks(z, place, re, im);
    for (size_t i = 0; i < count; i++) {
        double complex kick[NODES];
        free_map(lambda, c[i] * h, to_q[i], to_v[i]);
        double complex wave =
            CMPLX(to_q[i][0] + creal(lambda) * to_q[i][1], cimag(lambda) * to_q[i][1]);
        if (!small)
            large_kicks(z, c[i], wave, kick);
        for (int j = 0; j < NODES; j++) {
            double real = small ? re[j][i] : creal(kick[j]);
            double imaginary = small ? im[j][i] : cimag(kick[j]);
            to_q[i][j + 2] = share * imaginary;
            to_v[i][j + 2] = share * (creal(lambda) * imaginary + cimag(lambda) * real);
        }
    }
}

void oscillator_map(double omega, double damping, double h, double c, double to_q[NODES + 2],
                    double to_v[NODES + 2])
{
    double q[1][NODES + 2];
    double v[1][NODES + 2];
    oscillator_maps(omega, damping, h, 1, &c, q, v);
    memcpy(to_q, q[0], sizeof q[0]);
    memcpy(to_v, v[0], sizeof v[0]);
}

/* ---- Losses of a step ---- */

/* Velocity on the step for one unit input: Re(wave e^(z s)) + sum_m slope[m] s^m, s = t/h. */
struct velocity {
    double complex wave;
    double slope[NODES];
};

/* Gauss and Legendre's twelve points of 0 .. 1 and their weights, four by four. */
enum { GAUSS_QUADS = 3 };
static const double GAUSS_PLACE[GAUSS_QUADS][NODES] = {
    {0.009219682876640374655, 0.04794137181476257166, 0.1150486629028476565, 0.2063410228566912764},
    {0.3160842505009099031, 0.4373832957442655423, 0.5626167042557344577, 0.6839157494990900969},
    {0.7936589771433087236, 0.8849513370971523435, 0.9520586281852374283, 0.9907803171233596253}};
static const double GAUSS_WEIGHT[GAUSS_QUADS][NODES] = {
    {0.0235876681932559136, 0.05346966299765921548, 0.08003916427167311317, 0.1015837133615329609},
    {0.1167462682691774044, 0.1245735229067013925, 0.1245735229067013925, 0.1167462682691774044},
    {0.1015837133615329609, 0.08003916427167311317, 0.05346966299765921548, 0.0235876681932559136}};

/* Velocity at four places of a step for unit inputs, as oscillator_map, where |lambda h| < LARGE.
 */
static inline void small_velocities(double complex lambda, double h, const double c[NODES],
                                    quad to_v[LOSS_INPUTS])
{
    double complex z = lambda * h;
    double decay = creal(lambda);
    double frequency = cimag(lambda);
    struct waves moments[NODES];
    small_moments(z, c, moments);
    /* exp(z c) = 1 + z moments[0] */
    quad sine = (creal(z) * moments[0].im + cimag(z) * moments[0].re) / frequency;
    quad cosine = 1.0 + (creal(z) * moments[0].re - cimag(z) * moments[0].im);
    to_v[0] = -(decay * decay + frequency * frequency) * sine;
    to_v[1] = cosine + decay * sine;
    struct waves kick[NODES];
    small_kicks(moments, kick);
    for (int j = 0; j < NODES; j++)
        to_v[j + 2] = h / frequency * (decay * kick[j].im + frequency * kick[j].re);
}

/* Slow or moderate: Gauss quadrature of v^2. Twelve points leave (12!)^4/(25 (24!)^3) (2 omega
 * h)^24 of it (Abramowitz and Stegun 25.4.30), 4e-20 at LARGE. */
VECTOR_CLONES static void form_by_quadrature(double omega, double damping, double h,
                                             double form[LOSS_INPUTS][LOSS_INPUTS])
{
    double complex lambda = oscillator_lambda(omega, damping);
    for (int i = 0; i < GAUSS_QUADS; i++) {
        quad to_v[LOSS_INPUTS];
        quad weight;
        small_velocities(lambda, h, GAUSS_PLACE[i], to_v);
        memcpy(&weight, GAUSS_WEIGHT[i], sizeof weight);
        weight *= 2.0 * damping * omega * h;
        for (int r = 0; r < LOSS_INPUTS; r++) {
            quad weighed = weight * to_v[r];
            for (int s = 0; s <= r; s++) {
                quad part = weighed * to_v[s];
                form[r][s] += (part[0] + part[1]) + (part[2] + part[3]);
            }
        }
    }
}

/* Splits the response to input r into the wave and the particular solution, a cubic in s with
 * coefficients from the equation, from the highest down: with s = t/h
 *
 *   omega^2 q_m = f_m - (2 zeta omega/h) (m + 1) q_(m+1) - (1/h^2) (m + 2) (m + 1) q_(m+2)
 *
 * The wave has the rest of the initial values. */
static struct velocity split(double omega, double damping, double h, int r)
{
    double q[NODES + 2] = {0};
    double coupling = 2.0 * damping * omega / h;
    double inertia = 1.0 / (h * h);
    /* the cubic, from its highest power down */
    if (r >= 2) {
        for (int m = NODES - 1; m >= 0; m--)
            q[m] = (collocation.monomial[r - 2][m] - coupling * (m + 1) * q[m + 1] -
                    inertia * (m + 2) * (m + 1) * q[m + 2]) /
                   (omega * omega);
    }
    /* the wave A e^(lambda t): Re A is its velocity v0, Re(lambda A) its acceleration */
    double q0 = (r == 0) - q[0];
    double v0 = (r == 1) - q[1] / h;
    double complex lambda = oscillator_lambda(omega, damping);
    double rate = -2.0 * damping * omega * v0 - omega * omega * q0;
    struct velocity velocity = {.wave = CMPLX(v0, (creal(lambda) * v0 - rate) / cimag(lambda))};
    /* and the cubic's velocity */
    for (int m = 0; m + 1 < NODES; m++)
        velocity.slope[m] = (m + 1) * q[m + 1] / h;
    return velocity;
}

/* int_0^1 v_a v_b ds of two such velocities: 2 Re(A e^(zs)) Re(B e^(zs)) = Re(A B e^(2zs)) +
 * Re(A conj(B)) e^(2 Re(z) s); `swinging`, `steady` and `moment` are the integrals of e^(2zs),
 * e^(2 Re(z) s) and s^m e^(zs). */
static double product_integral(const struct velocity *a, const struct velocity *b,
                               double complex swinging, double steady,
                               const double complex moment[NODES])
{
    double sum =
        0.5 * creal(a->wave * b->wave * swinging) + 0.5 * creal(a->wave * conj(b->wave)) * steady;
    for (int m = 0; m < NODES; m++) {
        sum += creal(a->wave * moment[m]) * b->slope[m] + creal(b->wave * moment[m]) * a->slope[m];
        for (int n = 0; n < NODES; n++)
            sum += a->slope[m] * b->slope[n] / (m + n + 1);
    }
    return sum;
}

/* Fast: waves and polynomial integrated in closed form. */
static void form_closed(double omega, double damping, double h,
                        double form[LOSS_INPUTS][LOSS_INPUTS])
{
    double complex z = oscillator_lambda(omega, damping) * h;
    double complex swinging = (cexp(2.0 * z) - 1.0) / (2.0 * z);
    double steady = expm1(2.0 * creal(z)) / (2.0 * creal(z));
    double complex moment[NODES]; /* int_0^1 s^m e^(z s) ds */
    moment[0] = (cexp(z) - 1.0) / z;
    for (int m = 1; m < NODES; m++)
        moment[m] = (cexp(z) - m * moment[m - 1]) / z;
    struct velocity velocity[LOSS_INPUTS];
    for (int r = 0; r < LOSS_INPUTS; r++)
        velocity[r] = split(omega, damping, h, r);
    for (int r = 0; r < LOSS_INPUTS; r++)
        for (int s = 0; s <= r; s++)
            form[r][s] = 2.0 * damping * omega * h *
                         product_integral(&velocity[r], &velocity[s], swinging, steady, moment);
}

void oscillator_loss_form(double omega, double damping, double h,
                          double form[LOSS_INPUTS][LOSS_INPUTS])
{
    memset(form, 0, sizeof(double[LOSS_INPUTS][LOSS_INPUTS]));
    /* the particular solution cancels against the wave like (omega h)^-4 for slow oscillators */
    if (omega * h < LARGE)
        form_by_quadrature(omega, damping, h, form);
    else
        form_closed(omega, damping, h, form);
    for (int r = 0; r < LOSS_INPUTS; r++)
        for (int s = r + 1; s < LOSS_INPUTS; s++)
            form[r][s] = form[s][r];
}

/* ---- Series for slow oscillators ---- */

/* Angles below this: the terms fall from the first on, without cancellation. */
static const double LARGEST = 3.0;

enum { TERMS = 14 };

/* Terms to the last bit, by the square of the angle: 2 square^n/(2n + 2)! < 1e-17. */
static const struct {
    double below;
    int terms;
} NEEDED[] = {{2e-3, 4}, {8e-2, 6}, {0.64, 8}, {2.3, 10}, {5.9, 12}, {INFINITY, TERMS}};

/* With t = h s, s up to c, q = int sin(omega (t' - t))/omega f dt is, term by term of the sine,
 *
 *   h^2 sum_k (-angle^2)^k int (c - s)^(2k+1)/(2k+1)! f ds,   int ... s^m ds = c^n m!/n!,
 *
 * n = m + 2k + 2, and v by the cosine h times the same with n = m + 2k + 1. Of Lagrange's
 * polynomials for f: [k - 1][point][j], the last row of v at the end; to 20 digits from exact
 * nodes. Those of k = 0 are the collocation's own. */
_Alignas(32) static const double TERM[TERMS - 1][SERIES_ROWS][NODES] = {
    {{1.3679100329288310001e-6, -6.1179986150319215951e-7, 2.959407760801245367e-7,
      -8.3720558005294148187e-8},
     {0.00052341013886192910768, -0.000054817861442063913605, 0.000036282152681481352839,
      -0.000010683907931251512588},
     {0.0062682100790722083336, 0.0021719176650326402769, -0.000054817861442063913605,
      0.000010515428395022715244},
     {0.018511028703621337503, 0.011771729769452096185, 0.00096094387504494204851,
      1.3679100329288310001e-6},
     {0.02335938320745365766, 0.016344400762657348008, 0.0019531799896335496151,
      9.7027069221113838277e-6},
     {0.075306842584076434255, 0.073184919328102337556, 0.017755671748358302909,
      0.00041923300612959194737}},
    {{2.2476297070496820176e-10, -1.0612333369075314419e-10, 5.1570444983923998836e-11,
      -1.4606457558560727417e-11},
     {2.1105473626924205313e-6, -4.9648896931275693073e-7, 2.5166120987998739134e-7,
      -7.1704957414647215649e-8},
     {0.00011456117589448653738, 9.0425858302168886062e-6, 3.0551832543371033889e-6,
      -1.0329666721887539573e-6},
     {0.0006877532940599513161, 0.00020872895814489131752, 6.8160814318170845498e-6,
      -1.4019936928189673873e-6},
     {0.0010128133967992847763, 0.00036328802362086499805, 0.000014187348193274982593,
      -1.3998797245358680177e-6},
     {0.0054343745379790437338, 0.002737648398839339227, 0.00016114197730610958449,
      1.6841920884078804919e-7}},
    {{1.9588843154163821995e-14, -9.5164758089388981005e-15, 4.6371665545923246539e-15,
      -1.3143375679582421504e-15},
     {4.348863803049143507e-9, -1.3230849296433881366e-9, 6.4614554710294553718e-10,
      -1.8300624618368388418e-10},
     {1.02710996030811433e-6, -6.5079493210822805171e-8, 6.4159666949602544939e-8,
      -1.9191810421195089887e-8},
     {0.00001230915100810637878, 1.4191194110858781038e-6, 3.2244420671946590437e-7,
      -1.0422297681441949909e-7},
     {0.0000210964629108620961, 3.395162971062623495e-6, 4.524969738339227198e-7,
      -1.4253555417134072713e-7},
     {0.00015766624016091773703, 0.000039086725324593107632, 2.2601899889227442126e-6,
      -6.0045706173517617232e-7}},
    {{1.0575164181127204136e-18, -5.2288239210649643016e-19, 2.5525112168944243731e-19,
      -7.2381727403944438518e-20},
     {5.4592806672056217585e-12, -1.8949157685689480467e-12, 9.166882685737871057e-13,
      -2.592196690631249599e-13},
     {5.5041859161987991259e-9, -8.3564537500600111886e-10, 4.9851944013494549419e-10,
      -1.4451822706552838933e-10},
     {1.3028125478602030564e-7, -5.9838586358282974212e-10, 6.4854280660712761672e-9,
      -1.9787040974858136508e-9},
     {2.5931145392301278556e-7, 8.7367095487684323378e-9, 1.0891622363135066404e-8,
      -3.3665935950573777713e-9},
     {2.4771995948580413108e-6, 2.254826718551777459e-7, 7.7524240742074232698e-8,
      -2.4474585056704224164e-8}},
    {{3.8831643193573830011e-23, -1.9431270539196102498e-23, 9.4978481317829469907e-24,
      -2.6942295104752435114e-24},
     {4.6201438528040871113e-15, -1.7388639193999627665e-15, 8.3913747608165976079e-16,
      -2.3720469356979457614e-16},
     {1.9677954844052258054e-11, -4.1752221351101545011e-12, 2.2099829196486323043e-12,
      -6.3275196457169595368e-13},
     {9.1397442510703545463e-10, -7.983492298666345745e-11, 6.551894510299227858e-11,
      -1.9337009989494192058e-11},
     {2.1096376915924221553e-9, -1.1515520289111584004e-10, 1.3280465345551125842e-10,
      -3.9611443370007675796e-11},
     {2.4498412775433130754e-8, -3.4603131719913124538e-10, 1.2908164374211687878e-9,
      -3.9108951021344952155e-10}},
    {{1.0326631242841496044e-27, -5.212405360380672135e-28, 2.550242795955498713e-28,
      -7.2360587682789081164e-29},
     {2.8166880626124880485e-18, -1.1200206930544781408e-18, 5.4040836269161511794e-19,
      -1.5276993708016363297e-19},
     {5.0356814036263704899e-14, -1.2891603138579354254e-14, 6.5156144369144049186e-15,
      -1.8545684052487176926e-15},
     {4.570560528241698885e-12, -6.756118416928072181e-13, 4.1359211996794697976e-13,
      -1.1996612340721572288e-13},
     {1.2222341108397781776e-11, -1.4577345530778541499e-12, 9.9758215493083923888e-13,
      -2.9144311252104215084e-13},
     {1.6694077038816150849e-10, -1.4899322172819434926e-11, 1.2122147166007688781e-11,
      -3.5731570131336163484e-12}},
    {{2.0805845931910754454e-32, -1.0571017178009503417e-32, 5.1758980585443113933e-33,
      -1.4689020440656882836e-33},
     {1.2965250322884449985e-21, -5.3650818511923096335e-22, 2.5903379774859705757e-22,
      -7.3242562001306828833e-23},
     {9.6890332596933148561e-17, -2.8028613835873567452e-17, 1.3863693283020730563e-17,
      -3.9339882845645404067e-18},
     {1.7136597626189736512e-14, -3.322747642887152228e-15, 1.8228027796813677401e-15,
      -5.2362795192405938863e-16},
     {5.3054873914987327745e-14, -8.9472385031444936767e-15, 5.1834844069965405269e-15,
      -1.4963464949655216213e-15},
     {8.3270351647891373807e-13, -1.2116673248418317796e-13, 7.4919820524642310062e-14,
      -2.1740231337391222578e-14}},
    {{3.2856700343610295863e-37, -1.6779964495802033185e-37, 8.2209140034659078488e-38,
      -2.333439458687751415e-38},
     {4.6667189679562737677e-25, -1.9904102651270591789e-25, 9.6189904576880476571e-26,
      -2.7205033266027010635e-26},
     {1.4535751877827127887e-19, -4.5847425635798776005e-20, 2.2426084037560410529e-20,
      -6.3529437854050060021e-21},
     {4.9997657862477545794e-17, -1.1507536431853042935e-17, 5.9892848193072136236e-18,
      -1.7106774083389045058e-18},
     {1.791237692495943605e-16, -3.7175072531490032992e-17, 1.9965494887259480173e-17,
      -5.7221219195015430559e-18},
     {3.1749132825468466049e-15, -6.0063196787618401683e-16, 3.3288409232161717134e-16,
      -9.5708152646758996226e-17}},
    {{4.1763974663125732848e-42, -2.1417499707152480171e-42, 1.0498093901476732723e-42,
      -2.980187828941063363e-43},
     {1.3497403911181650757e-28, -5.8951773279543839276e-29, 2.8518078357550828892e-29,
      -8.0678177978309723381e-30},
     {1.7486378205709388981e-22, -5.8837259656310216955e-23, 2.860580375856414285e-23,
      -8.0958906806225282317e-24},
     {1.1680118816736381745e-19, -3.0302415642587732569e-20, 1.5325999210030525334e-20,
      -4.3619188896569320896e-21},
     {4.8405619746434495961e-19, -1.1567056861852112766e-19, 5.9670214135749657148e-20,
      -1.7024080650357003256e-20},
     {9.5596680980882028848e-18, -2.1417795750869254741e-18, 1.1241049254678185604e-18,
      -3.2135820184476625422e-19}},
    {{4.3649029238466146266e-47, -2.2460620518160443176e-47, 1.1013883167563518795e-47,
      -3.1269502548911475462e-48},
     {3.2058457308019505112e-32, -1.4272769824108556528e-32, 6.9112933815281092312e-33,
      -1.9557219305243061857e-33},
     {1.7248231324079383957e-25, -6.1027009509512921252e-26, 2.9570367635424725974e-26,
      -8.3644770442833607716e-27},
     {2.2348621256807869115e-22, -6.3371644806498337075e-23, 3.1515720623510931454e-23,
      -8.9492306260496632648e-24},
     {1.07108546641275141e-21, -2.8369585976464771469e-22, 1.4295469649011585408e-22,
      -4.0665163893162220761e-23},
     {2.3317052448173895177e-20, -5.8877713124633107094e-21, 2.9974488927994602119e-21,
      -8.5378896511878344848e-22}},
    {{3.8171456635667908044e-52, -1.9698116986121720656e-52, 9.6625803768344867219e-53,
      -2.7435551341112125437e-53},
     {6.36523966936990748e-36, -2.8789428504877985052e-36, 1.3953640830671502302e-36,
      -3.9494829205587880179e-37},
     {1.4205480450998842797e-28, -5.2324771992935128852e-29, 2.5306721306736143924e-29,
      -7.1564544755969916424e-30},
     {3.5674127220096984416e-25, -1.0837069607125544186e-25, 5.3335126471564558631e-26,
      -1.5122445994224240212e-26},
     {1.9767797049801902805e-24, -5.6652434359062322358e-25, 2.8136138095011195735e-25,
      -7.9879171243560665218e-26},
     {4.7021577776654042387e-23, -1.2986693450242717536e-23, 6.4913692539680401913e-24,
      -1.8445518740725246656e-24}},
    {{2.8342741469933450193e-57, -1.4661549789935608876e-57, 7.1941008171511160726e-58,
      -2.0428263511149321283e-58},
     {1.0722732112431261734e-39, -4.9143640569848354415e-40, 2.3839424368992266865e-40,
      -6.7490940348220123865e-41},
     {9.9171041928306054431e-32, -3.7753173996786993267e-32, 1.824173670810365859e-32,
      -5.1579181454855088423e-33},
     {4.823743956256803561e-28, -1.5482820013637673142e-28, 7.5692071268131229464e-29,
      -2.1440107258127028017e-29},
     {3.0899167220753541084e-27, -9.4261782724156863211e-28, 4.637936415137419099e-28,
      -1.3149627312272992609e-28},
     {7.9725836698737969495e-26, -2.3613592039309346086e-26, 1.1667174620339088026e-26,
      -3.3099164359229774729e-27}},
    {{1.8091215137156768714e-62, -9.3780021327585612895e-63, 4.6027570019062337188e-63,
      -1.3070818077846227824e-63},
     {1.5519029883401836012e-43, -7.1930100846407636802e-44, 3.492069894536582463e-44,
      -9.8883036479773019788e-45},
     {5.9437829433707084971e-35, -2.3258559529185190554e-35, 1.123355726334667475e-35,
      -3.1762387511629639656e-36},
     {5.5967057015249379579e-31, -1.8791839967029237923e-31, 9.1468627582939214097e-32,
      -2.589166558664349743e-32},
     {4.143745876431554854e-30, -1.329990709023926717e-30, 6.5035616562342183691e-31,
      -1.8422209596121206378e-31},
     {1.1525812192855824997e-28, -3.6110343527662226367e-29, 1.7706931516412848089e-29,
      -5.0178112793534102035e-30}},
};

bool oscillator_series_reaches(double angle)
{
    return angle < LARGEST;
}

static inline const double *first_term(int row)
{
    if (row == STEP_POINTS)
        return collocation.weight;
    return row < NODES ? collocation.position[row] : collocation.position_end;
}

/* Horner's rule on all rows. */
VECTOR_CLONES static void sum_up(int terms, double square, const double scales[SERIES_ROWS],
                                 double by[SERIES_ROWS][NODES])
{
    quad sum[SERIES_ROWS];
    for (int row = 0; row < SERIES_ROWS; row++)
        sum[row] = *(const quad *)TERM[terms - 2][row];
    for (int k = terms - 2; k > 0; k--) {
#pragma GCC unroll 6
        for (int row = 0; row < SERIES_ROWS; row++)
            sum[row] = *(const quad *)TERM[k - 1][row] - square * sum[row];
    }
#pragma GCC unroll 6
    for (int row = 0; row < SERIES_ROWS; row++) {
        quad first;
        memcpy(&first, first_term(row), sizeof first);
        sum[row] = first - square * sum[row];
    }
    for (int row = 0; row < SERIES_ROWS; row++) {
        quad scaled = sum[row] * scales[row];
        for (int j = 0; j < NODES; j++)
            by[row][j] = scaled[j];
    }
}

void oscillator_series_response(double angle, double h, double by[SERIES_ROWS][NODES])
{
    double square = angle * angle;
    double area = h * h;
    int row = 0;
    while (!(square < NEEDED[row].below))
        row++;
    sum_up(NEEDED[row].terms, square, (double[]){area, area, area, area, area, h}, by);
}
