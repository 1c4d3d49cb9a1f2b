// In: nothing. Out: the events that begin and end a segment, by the codes they have in logs.
export const eventNames = [
    'none', 'emitted', 'refracted', 'reflected', 'total_internal', 'absorbed', 'detected', 'escaped', 'cut_power', 'cut_depth',
    'leak', 'invalid', 'passed', 'scattered'] as const;

export const Ev = {
    none: 0, emitted: 1, refracted: 2, reflected: 3, total_internal: 4, absorbed: 5, detected: 6, escaped: 7, cut_power: 8,
    cut_depth: 9, leak: 10, invalid: 11, passed: 12, scattered: 13,
} as const;
