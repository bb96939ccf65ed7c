// The sum of the lights' terms, which are not negative.
//
// Source: Higham, Accuracy and Stability of Numerical Algorithms, 4.2, 4.3.

#piece plain
// In the order of the lights: the relative error of k terms is at most (k - 1) 2^-24.
/// A sum under way.
struct LightSum {
    LIGHT_PRECISION vec3 total;
};

/// The sum of no terms.
LightSum emptySum() { return LightSum(vec3(0.0)); }

/// Adds a term.
void addTerm(inout LightSum sum, vec3 term) { sum.total += term; }

/// The sum of the terms added so far.
vec3 totalOf(LightSum sum) { return sum.total; }

#piece pairwise
// In pairs, pairs of pairs and so on: partial[k] holds a sum of 2^k terms where bit k of the count is set, and a new term
// carries through them as a one does through a binary counter. Error at most about log2(k) 2^-24, up to 8191 terms.
/// A sum under way.
struct LightSum {
    vec3 partial[13];
    int count;
};

/// The sum of no terms.
LightSum emptySum() {
    LightSum sum;
    for (int i = 0; i < 13; ++i) sum.partial[i] = vec3(0.0);
    sum.count = 0;
    return sum;
}

/// Adds a term.
void addTerm(inout LightSum sum, vec3 term) {
    int place = 0;
    for (int bits = sum.count; (bits & 1) == 1; bits >>= 1) {
        term += sum.partial[place];
        ++place;
    }
    sum.partial[place] = term;
    ++sum.count;
}

/// The sum of the terms added so far.
vec3 totalOf(LightSum sum) {
    vec3 total = vec3(0.0);
    int place = 0;
    for (int bits = sum.count; bits > 0; bits >>= 1) {
        if ((bits & 1) == 1) total += sum.partial[place];
        ++place;
    }
    return total;
}

#piece compensated
// With what each addition rounds away carried along: about 2^-23 for any number of terms. `precise`, since compilers fold
// (x + y) - x to y. Source: Kahan, Further Remarks on Reducing Truncation Errors, CACM 8 (1965).
/// A sum under way, and by how much it is too large.
struct LightSum {
    vec3 total;
    vec3 excess;
};

/// The sum of no terms.
LightSum emptySum() { return LightSum(vec3(0.0), vec3(0.0)); }

/// Adds a term.
void addTerm(inout LightSum sum, vec3 term) {
    precise vec3 owed = term - sum.excess;
    precise vec3 total = sum.total + owed;
    precise vec3 added = total - sum.total;
    precise vec3 excess = added - owed;
    sum.excess = excess;
    sum.total = total;
}

/// The sum of the terms added so far.
vec3 totalOf(LightSum sum) { return sum.total; }
