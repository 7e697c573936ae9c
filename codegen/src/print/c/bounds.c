    double first[COUNT];
    double change[COUNT];
    double largest[COUNT];
    for (int j = 0; j < COUNT; j++) {
        first[j] = row[3 + (j % 2)] * NAME_change[j];
        change[j] = row[5] * NAME_change[j];
        largest[j] = row[6] * NAME_largest[j];
    }
