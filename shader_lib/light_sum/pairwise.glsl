// The sum of the lights' terms, in pairs, pairs of pairs and so on (L7).
//
// Model:  sum of t_i as a balanced tree. partial[k] holds a sum of 2^k terms where bit k of the count is set;
//         a new term carries through them as a one does through a binary counter.
// Range:  up to 8191 terms. Not negative, the relative error of k terms is at most about log2(k) 2^-24.
// Source: Higham, Accuracy and Stability of Numerical Algorithms, 4.2.
// Edges:  no terms give exactly 0; the order of the lights may change the last digits.

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
